#version 410
in vec3 n, i;
uniform samplerCube skybox;
out vec4 FragColor;
void main() { FragColor = texture(skybox, reflect(i, normalize(n))); }
