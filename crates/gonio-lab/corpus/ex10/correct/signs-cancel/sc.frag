#version 460 core
in vec3 wp;
in vec3 wn;
uniform vec3 u_view_pos;
uniform float refractionIndice;
uniform samplerCube cubemapSampler;
out vec4 FragColor;
void main()
{
    vec3 v = normalize(u_view_pos - wp);
    vec3 t = -refract(v, -normalize(wn), 1.0 / refractionIndice);
    FragColor = texture(cubemapSampler, t);
}
