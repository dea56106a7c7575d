#version 330 core
in vec4 v_world;
in vec4 v_norm4;
uniform vec3 u_light_pos;
uniform vec3 u_view_pos;
uniform vec3 materialColour;
uniform float shininess;
out vec4 FragColor;
// ------------
void main() {
  vec4 n = normalize(v_norm4);
  vec4 l = normalize(vec4(u_light_pos, 1.0) - v_world);
  vec4 v = normalize(vec4(u_view_pos, 1.0) - v_world);
  vec4 r = reflect(-l, n);
  vec4 colour = vec4(materialColour, 1.0);
  vec4 d = colour * dot(n, l);
  vec4 s = colour * pow(max(dot(r, v), 0.0), shininess);
  FragColor = d + s;
  FragColor.a = 1.0;
}
