#version 130
in vec3 position;
in vec3 normal;
uniform mat4 M, V, P, itM;
uniform vec3 u_light_pos, u_view_pos;
smooth out vec4 v_specular;
noperspective out float v_diffuse;
void main() {
  vec3 N = normalize((itM * vec4(normal, 0)).xyz);
  vec3 pos = (M * vec4(position, 1)).xyz;
  vec3 L = normalize(u_light_pos - pos), E = normalize(u_view_pos - pos);
  vec3 R = 2 * dot(N, L) * N - L;
  v_diffuse = max(0, dot(N, L));
  v_specular = vec4(pow(max(0, dot(R, E)), 32));
  gl_Position = P * V * vec4(pos, 1);
}
