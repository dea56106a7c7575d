#version 400
in VS { vec3 position; vec3 normal; vec2 uv; } v;
struct Light {
	vec3 light_pos;
	float ambient_strength;
	float diffuse_strength;
	float specular_strength;
};
uniform Light light;
uniform vec3 u_view_pos;
uniform float shininess;
uniform vec3 materialColour;
out vec4 FragColor;
void main()
{
	vec3 N = normalize(v.normal);
	vec3 L = normalize(light.light_pos - v.position);
	vec3 E = normalize(u_view_pos - v.position);
	vec3 R = reflect(-L, N);
	float d = light.diffuse_strength * max(0, dot(L, N));
	float s = light.specular_strength * pow(max(0, dot(E, R)), shininess);
	FragColor = vec4(materialColour * (d + s), 1);
}
