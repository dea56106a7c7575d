#version 150
in vec3 pos;
in vec3 n;
uniform vec3 lightPos;
uniform vec3 viewPos;
uniform float shininess;
out vec4 FragColor;
void main()
{
  vec3 nn = normalize(n);
  vec3 light = normalize(lightPos - pos);
  vec3 eye = normalize(viewPos - pos);
  vec3 refl = reflect(-light, nn);
  float I = max(dot(nn, light), 0.0) + pow(max(dot(refl, eye), 0.0), shininess);
  FragColor = vec4(I, I, I, 1.0);
}
