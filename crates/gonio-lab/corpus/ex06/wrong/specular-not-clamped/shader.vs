#version 400 core
in vec3 aPos, aNormal;
uniform mat4 MVP, model, itM;
out vec3 P3, N3;

void main() { gl_Position = MVP * vec4(aPos, 1.0); P3 = (model * vec4(aPos, 1.0)).xyz; N3 = normalize((itM * vec4(aNormal, 0.0)).xyz); }
