#version 410 core
in vec3 shade;
out vec4 FragColor;
void main() { FragColor = vec4(shade, 1.0); }
