#version 460 core
in Gouraud { vec3 diffuse; vec3 specular; } i;
out vec4 FragColor;
void main() { FragColor = vec4(i.diffuse + i.specular, 1); }
