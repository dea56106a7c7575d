#version 330 core
in vec3 FragPos;
in vec3 Normal;
out vec4 FragColor;
struct Light { vec3 light_pos; float ambient_strength; float diffuse_strength; float specular_strength; float constant; float linear; float quadratic; };
uniform Light light;
uniform vec3 viewPos;
uniform vec3 materialColour;
uniform float shininess;
void main() {
	vec3 lightDir = normalize(light.light_pos - FragPos);
	vec3 viewDir = normalize(viewPos - FragPos);
	vec3 normal = normalize(Normal);
	vec3 R = 2.0 * dot(normal, lightDir) * normal - lightDir;
	float spec = pow(max(dot(R, viewDir), 0.0), 8.0);
	float diff = max(dot(lightDir, normal), 0.0);
	float dist = length(light.light_pos - FragPos);
	float attenuation = 1.0 / (light.constant + light.linear * dist + light.quadratic * dist * dist);
	vec3 ambient = vec3(light.ambient_strength);
	vec3 diffuse = vec3(light.diffuse_strength * diff) * attenuation;
	vec3 specular = vec3(light.specular_strength * spec) * attenuation;
	FragColor = vec4((ambient + diffuse + specular) * materialColour, 1.0);
}
