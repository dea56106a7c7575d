#version 410
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
uniform mat4 M, V, P;
uniform vec3 u_light_pos;
out vec3 n, l;
void main() {
  mat4 MV = V * M;
  vec4 p = MV * vec4(position, 1.0);
  n = normalize(transpose(inverse(mat3(MV))) * normal);
  l = (V * vec4(u_light_pos, 1.0)).xyz - p.xyz;
  gl_Position = P * p;
}
