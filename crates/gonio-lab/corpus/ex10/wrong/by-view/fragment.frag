#version 130
in vec3 pos;
in vec3 nor;
uniform vec3 viewPos;
uniform float refractionIndice;
uniform samplerCube cubemapSampler;
out vec4 FragColor;


void main()
{
	float n = 1.0 / refractionIndice;	// eta_L / eta_T, air is 1
	vec3 N = normalize(nor);
	vec3 L = normalize(viewPos - pos);
	float NL = dot(N, L);
	vec3 T = (n * NL - sqrt(1.0 - n * n * (1.0 - NL * NL))) * N - n * L;
	FragColor = vec4(texture(cubemapSampler, pos - viewPos).rgb, 1.0);
}
