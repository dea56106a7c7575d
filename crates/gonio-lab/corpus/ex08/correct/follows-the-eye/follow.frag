#version 440 core
in vec3 dir;
uniform samplerCube cubemapSampler;
out vec4 FragColor;
void main()
{
	FragColor = texture(cubemapSampler, dir);
}
