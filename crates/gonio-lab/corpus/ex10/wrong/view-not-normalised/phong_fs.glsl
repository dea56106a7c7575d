#version 150
in vec3 v_ray;
in vec3 normal_v;
uniform float refractionIndice;
uniform samplerCube cubemapSampler;
out vec4 fragColor;
void main()
{
	vec3 r = refract(v_ray, normalize(normal_v), 1.0 / refractionIndice);
	fragColor = vec4(texture(cubemapSampler, r).rgb, 1.0);
}
