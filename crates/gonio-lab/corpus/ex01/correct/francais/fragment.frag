#version 330 core
in vec3 couleurSommet;
out vec4 FragColor;
void main() { FragColor = vec4(couleurSommet, 1.0); }
