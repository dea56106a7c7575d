#version 130
in vec3 v_pos;
in vec3 v_norm;
out vec4 FragColor;
struct Light
{
	vec3  light_pos;
	float ambient_strength, diffuse_strength, specular_strength;
	float constant, linear, quadratic;
};
uniform Light light;
uniform vec3  u_view_pos;
uniform vec3  materialColour;
uniform float shininess;

float power(float base, float e)
{
	if (base <= 0.0) return 0.0;      // log2(0) is undefined
	return exp2(e * log2(base));
}

void main()
{
	vec3 N = normalize(v_norm);
	vec3 L = normalize(light.light_pos - v_pos);
	vec3 view = normalize(u_view_pos - v_pos);
	vec3 R = -reflect(L, N);
	float D = length(v_pos - light.light_pos);
	float A = 1.0 / (light.constant + light.linear * D + light.quadratic * D * D);
	float dif = light.diffuse_strength * abs(dot(N, L));
	float spe = light.specular_strength * power(dot(R, view), shininess);
	FragColor = vec4(materialColour * (light.ambient_strength + A * (dif + spe)), 1.0);
}
