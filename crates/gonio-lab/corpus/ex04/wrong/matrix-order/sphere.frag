#version 330 core
in vec3 v_n;
in vec3 v_pos;
uniform vec3 u_light_pos;
uniform vec3 materialColour;
out vec4 FragColor;
void main() {
  vec3 n = normalize(v_n);
  vec3 l = normalize(u_light_pos - v_pos);
  float diffuse = max(dot(n, l), 0.0);
  FragColor = vec4(materialColour * diffuse, 1.0);
}
