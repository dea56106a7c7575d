#version 400 core
out vec4 FragColor;
precision mediump float;
in vec3 FragPos;
in vec3 Normal;
uniform vec3 viewPos;
uniform samplerCube cubemapSampler;
uniform float refractionIndice;


void main() {
  float ratio = 1.00 / refractionIndice;
  vec3 N = -normalize(Normal);
  vec3 V = normalize(viewPos - FragPos);
  vec3 R = refract(-V, N, ratio);
  FragColor = texture(cubemapSampler, R);
}
