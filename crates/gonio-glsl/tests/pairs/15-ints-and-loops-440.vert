#version 440
in vec3 position; in vec3 normal;
uniform mat4 M, V, P;
out vec3 v_n; out vec3 v_p; flat out uint mask;
void main() { v_n = mat3(M) * normal; v_p = vec3(M * vec4(position, 1)); mask = 1; mask <<= 2; gl_Position = P * V * vec4(v_p, 1); }
