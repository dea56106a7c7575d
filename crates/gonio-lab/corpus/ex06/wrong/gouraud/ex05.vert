#version 330 core
in vec3 position;
in vec3 normal;
uniform mat4 M, V, P, itM;
uniform vec3 u_light_pos, u_view_pos, materialColour;
out vec3 v_col;
void main() {
  vec4 w = M * vec4(position, 1.0);
  vec3 N = normalize(vec3(itM * vec4(normal, 0.0)));
  vec3 L = normalize(u_light_pos - w.xyz);
  vec3 E = normalize(u_view_pos - w.xyz);
  float diffuse = max(dot(N, L), 0.0);
  float specular = pow(max(dot(reflect(-L, N), E), 0.0), 32.0);
  v_col = (diffuse + specular) * materialColour;
  gl_Position = P * V * w;
}
