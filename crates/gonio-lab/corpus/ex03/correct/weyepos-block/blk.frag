#version 460 core
in Lit { vec3 colour; } lit;
out vec4 FragColor;
void main() { FragColor = vec4(lit.colour, 1.0); }
