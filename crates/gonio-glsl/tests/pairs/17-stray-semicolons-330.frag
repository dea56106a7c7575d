#version 330 core
out vec4 FragColor;
vec3 colour(void) { return vec3(1); };
void main(void) { FragColor = vec4(colour(), 1.0); };
