#version 330 core
in vec3 direction;
uniform samplerCube cubemapSampler;
out vec4 FragColor;
void main() {
  FragColor = vec4(texture(cubemapSampler, normalize(direction)).rgb, 1.0);
}
