#version 300 es
precision mediump float;
out vec4 fragColor;
in vec3 frag_pos;
in vec3 normal_v;
uniform vec3 viewPos;
struct Light {
  vec3 light_pos;
  float ambient_strength;
  float diffuse_strength;
  float specular_strength;
  float constant;
  float linear;
  float quadratic;
};
uniform Light light;
uniform float shininess;
uniform vec3 materialColour;
// ------------
void main() {
  vec3 N = normal_v;
  vec3 L = normalize(light.light_pos - frag_pos);
  vec3 V = normalize(viewPos - frag_pos);
  vec3 R = reflect(L, N);
  float spec = light.specular_strength * pow(max(dot(R, V), 0.0), shininess);
  float diff = light.diffuse_strength * max(dot(N, L), 0.0);
  float d = length(light.light_pos - frag_pos);
  float att = 1.0 / (light.constant + light.linear * d + light.quadratic * d * d);
  fragColor = vec4(materialColour * (light.ambient_strength + att * (diff + spec)), 1.0);
}
