#version 150
in vec3 v_frag_coord;
in vec3 v_normal;
uniform vec3 camPos;
uniform samplerCube cubemapSampler;
out vec4 FragColor;

void main()
{
	vec3 v = normalize(camPos - v_frag_coord);
	vec3 r = reflect(v, normalize(v_normal));
	FragColor = vec4(texture(cubemapSampler, -r).rgb, 1.0);
}
