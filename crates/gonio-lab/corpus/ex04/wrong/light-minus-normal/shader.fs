#version 400 core
#define NR_LIGHTS 2
struct Light { vec3 light_pos; };
uniform Light lights[NR_LIGHTS];
in vec3 wp;
in vec3 wn;
uniform vec3 materialColour;
out vec4 FragColor;


void main()
{
    float sum = 0.0;
    vec3 n = normalize(wn);
    for (int i = 0; i < NR_LIGHTS; ++i)
{
        vec3 l = normalize(lights[i].light_pos - n);
        sum += max(dot(n, l), 0.0);
    }
    FragColor = vec4(sum * materialColour, 1.0);
}
