#version 150
in vec3 worldPos;
in vec3 worldNormal;
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
uniform Light light;
uniform vec3 u_view_pos;
uniform vec3 materialColour;

// x^32 without pow
float pow32(float x)
{
	float x2 = x * x;
	float x4 = x2 * x2;
	float x8 = x4 * x4;
	float x16 = x8 * x8;
	return x16 * x16;
}

void main()
{
	vec3 n = normalize(worldNormal);
	vec3 l = light.light_pos - worldPos;
	float d = length(l);
	l = l / d;
	vec3 e = u_view_pos - worldPos;
	vec3 r = reflect(-l, n);
	float spec = pow32(max(dot(r, e), 0.0));
	float diff = max(dot(n, l), 0.0);
	float att = 1.0 / (light.constant + light.linear * d + light.quadratic * d * d);
	vec3 col = materialColour * light.ambient_strength;
	col += materialColour * light.diffuse_strength * diff * att;
	col += materialColour * light.specular_strength * spec * att;
	FragColor = vec4(col, 1.0);
}
