#version 440 core
in vec3 x, n;
uniform vec3 u_light_pos, u_view_pos, materialColour;
uniform float shininess;
out vec4 FragColor;
void main() {
  vec3 N = normalize(n), L = normalize(u_light_pos - x), V = normalize(u_view_pos - x);
  float c = max(dot(N, L), 0.0);
  // (diff + spec) * cos(theta), slide "rendering equation"
  float spec = pow(max(dot(reflect(-L, N), V), 0.0), shininess);
  FragColor = vec4(materialColour * (1.0 + spec) * c, 1.0);
}
