#version 330 core
in vec3 position, normal;
uniform mat4 MVP, M, itM;
out vec3 P3, N3;
void main() { gl_Position = MVP * vec4(position, 1.0); P3 = (M * vec4(position, 1.0)).xyz; N3 = normalize((itM * vec4(normal, 0.0)).xyz); }
