#version 330 core
out vec4 FragColor;

struct Light {
	vec3 light_pos;

	float ambient_strength;
	float diffuse_strength;
	float specular_strength;

	float constant;
	float linear;
	float quadratic;
};

in vec3 FragPos;
in vec3 Normal;
in vec2 TexCoords;

uniform vec3 viewPos;
uniform Light light;
uniform vec3 materialColour;
uniform float shininess;

// function prototypes
vec3 CalcPointLight(Light light, vec3 normal, vec3 fragPos, vec3 viewDir);


void main()
{
	// properties
	vec3 norm = normalize(Normal);
	vec3 viewDir = normalize(viewPos - FragPos);

	vec3 result = CalcPointLight(light, norm, FragPos, viewDir);
	FragColor = vec4(result, 1.0);
}

// calculates the color when using a point light.
vec3 CalcPointLight(Light light, vec3 normal, vec3 fragPos, vec3 viewDir)
{
	vec3 lightDir = normalize(light.light_pos - fragPos);
	// diffuse shading
	float diff = max(dot(normal, lightDir), 0.0);
	// specular shading
	vec3 reflectDir = reflect(-lightDir, normal);
	float spec = pow(max(dot(viewDir, normal), 0.0), shininess);
	// attenuation
	float distance = length(light.light_pos - fragPos);
	float attenuation = 1.0 / (light.constant + light.linear * distance + light.quadratic * (distance * distance));
	// combine results
	vec3 ambient = light.ambient_strength * materialColour;
	vec3 diffuse = light.diffuse_strength * diff * materialColour;
	vec3 specular = light.specular_strength * spec * materialColour;
	diffuse *= attenuation;
	return (ambient + diffuse + specular);
}
