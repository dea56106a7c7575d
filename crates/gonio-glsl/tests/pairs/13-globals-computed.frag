#version 330 core
in vec3 v_normal;
uniform vec3 lightColor = vec3(1, 0.5, 0);
uniform float ambient = 0.1, gain = 2;
uniform int count = 3;
vec3 amb = ambient * lightColor;
out vec4 color;
void main() {
  const vec3 N = normalize(v_normal);
  color = vec4(amb + N * gain / count, 1.f);
}
