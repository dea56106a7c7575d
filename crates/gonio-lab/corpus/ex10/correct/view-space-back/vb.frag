#version 410 core
in vec3 e;
in vec3 ne;
uniform mat4 V;
uniform float refractionIndice;
uniform samplerCube cubemapSampler;
out vec4 FragColor;
void main()
{
    vec3 r = refract(normalize(e), normalize(ne), 1.0 / refractionIndice);
    FragColor = texture(cubemapSampler, transpose(mat3(V)) * r);
}
