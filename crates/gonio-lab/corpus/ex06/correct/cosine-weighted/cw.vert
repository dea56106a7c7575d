#version 440 core
in vec3 position;
in vec3 normal;
uniform mat4 M, V, P, itM;
out vec3 x, n;
void main() {
  vec4 w = M * vec4(position, 1.0);
  x = w.xyz;
  n = normalize(vec3(itM * vec4(normal, 0.0)));
  gl_Position = P * V * w;
}
