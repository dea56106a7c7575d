#version 330 core
in vec3 worldPosition;
in vec3 worldNormal;
uniform vec3 lightPos;
uniform vec3 viewPos;
uniform vec3 materialColour;
uniform float shininess;
out vec4 FragColor;
float getDiffuse(vec3 N, vec3 L) { return max(dot(N, L), 0.0); }
float getSpecular(vec3 N, vec3 L, vec3 V) {
  vec3 R = reflect(-L, N);
  return pow(max(dot(R, V), 0.0), shininess);
}
float getAmbient() { return 0.2; }
void main() {
  vec3 N = normalize(worldNormal);
  vec3 L = normalize(lightPos - worldPosition);
  vec3 V = normalize(viewPos - worldPosition);
  float light = getAmbient() + getDiffuse(N, L) + getSpecular(N, L, V);
  FragColor = vec4(light * materialColour, 1.0);
}
