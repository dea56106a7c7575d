#version 400
in vec3 position;
in vec3 normal;
uniform mat4 M, V, P, itM;
uniform vec3 u_light_pos, u_view_pos, materialColour;
uniform float shininess;
out vec3 v_diffuse;
out vec3 v_specular;
void main() {
  vec4 w = M * vec4(position, 1.0);
  vec3 N = normalize((itM * vec4(normal, 0.0)).xyz);
  vec3 L = normalize(u_light_pos - w.xyz);
  vec3 E = normalize(u_view_pos - w.xyz);
  v_diffuse = materialColour * max(dot(N, L), 0.0);
  v_specular = vec3(pow(max(dot(reflect(-L, N), E), 0.0), shininess));
  gl_Position = P * V * w;
}
