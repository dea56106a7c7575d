#version 460 core
in Sky { vec3 direction; vec3 normal; } sky;
uniform samplerCube cubemapSampler;
out vec4 FragColor;
void main()
{
    //FragColor = vec4(sky.normal, 1);
    FragColor = vec4(textureLod(cubemapSampler, sky.direction, 0.0).rgb, 1);
}
