#version 440 core
struct Angles { float nl; float rv; };
in vec3 wp;
in vec3 wn;
uniform vec3 u_light_pos;
uniform vec3 u_view_pos;
uniform vec3 materialColour;
out vec4 FragColor;
Angles angles() {
  vec3 n = -normalize(wn), l = normalize(u_light_pos - wp), v = normalize(u_view_pos - wp);
  return Angles(dot(n, l), dot(reflect(-l, n), v));
}
void main() {
  Angles a = angles();
  vec3 diff = max(a.nl, 0.0) * materialColour;
  vec3 spec = pow(max(a.rv, 0.0), 32.0) * materialColour;
  FragColor = vec4(diff + spec, 1.0);
}
