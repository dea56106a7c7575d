#version 410
layout(location=0) in vec3 position;
layout(location=2) in vec3 normal;
uniform mat4 M, V, P, itM;
uniform vec3 u_view_pos;
out vec3 n, i;
void main() {
  vec3 w = (M * vec4(position, 1)).xyz;
  n = normalize((itM * vec4(normal, 0)).xyz);
  i = w - u_view_pos;
  gl_Position = P * V * vec4(w, 1);
}
