#version 440 core
in vec3 pos;
in vec3 nrm;
uniform vec3 viewPos;
struct Light { vec3 light_pos; float ambient_strength; float diffuse_strength; float specular_strength; float constant; float linear; float quadratic; };
uniform Light light;
uniform vec3 materialColour;
out vec4 color_out;
void main() {
  vec3 n = normalize(nrm);
  vec3 toL = light.light_pos - pos;
  vec3 l = normalize(toL);
  float d = length(toL);
  float diff = dot(n, l) * 0.5f + 0.5f;
  float spec = pow(max(dot(reflect(-l, n), normalize(viewPos - pos)), 0.0f), 32.0f);
  float att = 1.0f / (light.constant + light.linear * d + light.quadratic * d * d);
  vec3 colour = materialColour;
  colour *= light.ambient_strength + att * (light.diffuse_strength * diff + light.specular_strength * spec);
  color_out = vec4(colour, 1.0f);
}
