#version 330 core
in vec3 position;
in vec3 normal;
uniform mat4 M, V, P, itM;
out vec3 p;
out vec3 n;
void main() {
  p = vec3(M * vec4(position, 1.0));
  n = normalize(vec3(itM * vec4(normal, 0.0)));
  gl_Position = P * V * vec4(p, 1.0);
}
