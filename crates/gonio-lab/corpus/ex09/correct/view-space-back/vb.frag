#version 330 core
in vec3 e;
in vec3 ne;
uniform mat4 V;
uniform samplerCube cubemapSampler;
out vec4 FragColor;
void main()
{
    vec3 r = reflect(normalize(e), normalize(ne));
    r = vec3(inverse(V) * vec4(r, 0.0));
    FragColor = texture(cubemapSampler, r);
}
