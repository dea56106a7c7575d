#version 400 core
out vec4 FragColor;
precision mediump float;

in vec3 FragPos;
in vec3 Normal;

uniform vec3 viewPos;

struct Light {
  vec3 light_pos;
  float ambient_strength;
  float diffuse_strength;
  float specular_strength;
  // attenuation factors
  float constant;
  float linear;
  float quadratic;
};
uniform Light light;
uniform float shininess;
uniform vec3 materialColour;

float specularCalculation(vec3 N, vec3 L, vec3 V) {
  vec3 R = reflect(L, N);
  float cosTheta = dot(R, V);
  float spec = pow(max(cosTheta, 0.0), 32.0);
  return light.specular_strength * spec;
}


void main() {
  vec3 N = normalize(Normal);
  vec3 L = normalize(light.light_pos - FragPos);
  vec3 V = normalize(viewPos - FragPos);
  float specular = specularCalculation(N, L, V);
  float diffuse = light.diffuse_strength * max(dot(N, L), 0.0);
  float distance = length(light.light_pos - FragPos);
  float attenuation = 1.0 / (light.constant + light.linear * distance + light.quadratic * distance * distance);
  float total = light.ambient_strength + attenuation * (diffuse + specular);
  FragColor = vec4(materialColour * vec3(total), 1.0);
}
