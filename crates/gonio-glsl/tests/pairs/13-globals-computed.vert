#version 330 core
in vec3 position; in vec3 normal;
uniform mat4 M, V, P;
mat4 MVP = P * V * M; // all together
vec3 n = normalize(normal), up = vec3(0, 1, 0);
const float bias = 1e-3;
out vec3 v_normal;
void main() {
  v_normal = mat3(M) * n + up * bias;
  gl_Position = MVP * vec4(position, 1.0);
}
