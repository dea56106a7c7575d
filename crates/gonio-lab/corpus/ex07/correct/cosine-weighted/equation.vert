#version 330 core
in vec3 position;
in vec3 normal;
uniform mat4 M, V, P, itM;
out vec3 x;
out vec3 n;
void main() { x = (M * vec4(position, 1.)).xyz; n = normalize(mat3(itM) * normal); gl_Position = P * V * vec4(x, 1.); }
