#version 440 core
in vec3 eyePos3;
in vec3 eyeNormal;
uniform mat4 V;
struct Light { vec3 light_pos; float ambient_strength; float diffuse_strength; float specular_strength; float constant; float linear; float quadratic; };
uniform Light light;
uniform vec3 materialColour;
uniform float shininess;
out vec4 FragColor;
void main()
{
  vec3 lightEye = vec3(V * vec4(light.light_pos, 1.0));
  vec3 n = normalize(eyeNormal);
  vec3 s = normalize(lightEye - eyePos3);
  vec3 v = -normalize(eyePos3);
  vec3 r = reflect(-s, n);
  float d = distance(lightEye, eyePos3);
  float f = light.constant + light.linear * d + light.quadratic * d * d;
  vec3 c = materialColour * light.ambient_strength;
  c += materialColour * light.diffuse_strength * max(dot(s, n), 0.0) / f;
  c += materialColour * light.specular_strength * pow(max(dot(n, v), 0.0), shininess) / f;
  FragColor = vec4(c, 1.0);
}
