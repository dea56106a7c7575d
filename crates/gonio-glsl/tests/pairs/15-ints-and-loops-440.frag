#version 440
in vec3 v_n, v_p; flat in uint mask;
out vec4 FragColor;
uniform vec3 lightPos[3];
uniform double gain = 1.0lf;
float attenuation(float d, const in float c) { return 1 / (c + d * d); }
vec3 shade(vec3 n, int i) {
  if (i < 0) return vec3(0);
  vec3 l = lightPos[i] - v_p;
  float d = length(l);
  return vec3(max(0, dot(n, l / d))) * attenuation(d, 1);
}
void main() {
  vec3 sum = vec3(0, 0, 0);
  int i = 0;
  while (true) { if (i >= lightPos.length()) break; sum += shade(normalize(v_n), i++) ; }
  float f = i;
  f -= 2; f = -1 + f; bool big = f > 0 || i == 3;
  float w = big ? 1 : 0.5;
  uint u = mask & 7;
  double d = gain * 2;
  FragColor = vec4(sum * float(d), w) * u;
}
