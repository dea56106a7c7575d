#version 150
in vec3 v_ray;
in vec3 v_normal;
uniform float refractionIndice;
uniform samplerCube cubemapSampler;
out vec4 FragColor;
void main()
{
	vec3 r = refract(normalize(v_ray), normalize(v_normal), 1.0 / refractionIndice);
	FragColor = vec4(texture(cubemapSampler, r).rgb, 1.0);
}
