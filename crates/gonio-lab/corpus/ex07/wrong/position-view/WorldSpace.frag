#version 400 core
in vec3 WfragPos;
in vec3 WfragNormal;
uniform vec3 WeyePos;
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
uniform vec3 materialColour;
uniform float shininess;
out vec4 FragColor;

struct Vectors { vec3 N, L, V, R; };

Vectors vectors()
{
	Vectors v;
	v.N = normalize(WfragNormal);
	v.L = normalize(light.light_pos - WfragPos);
	v.V = normalize(WeyePos - WfragPos);
	v.R = reflect(-v.L, v.N);
	return v;
}

// ------------
void main()
{
	Vectors v = vectors();
	float d = distance(WfragPos, light.light_pos);
	vec3 k = vec3(light.constant, light.linear, light.quadratic);
	float att = 1.0 / dot(k, vec3(1.0, d, d * d));
	vec3 result = vec3(light.ambient_strength);
	result += att * light.diffuse_strength * max(dot(v.N, v.L), 0.0);
	result += att * light.specular_strength * pow(max(dot(v.R, v.V), 0.0), shininess);
	FragColor = vec4(result * materialColour, 1.0);
}
