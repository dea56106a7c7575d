#version 440
#define NB_LIGHTS 1

struct Light {
    vec3 light_pos;
    float ambient_strength, diffuse_strength, specular_strength;
    float constant, linear, quadratic;
};
uniform Light lights[NB_LIGHTS];
uniform vec3 viewPos;
uniform vec3 materialColour;
uniform float shininess;

in vec3 world; in vec3 n;
out vec4 FragColor;

float phong(Light li, vec3 N, vec3 E)
{
    vec3 L = li.light_pos - world;
    float d = length(L);
    L /= d;
    float att = 1 / (d * d);
    float dif = li.diffuse_strength * max(dot(N, L), 0.2);
    float spe = li.specular_strength * pow(max(dot(reflect(-L, N), E), 0), shininess);
    return li.ambient_strength + att * (dif + spe);
}

void main()
{
    vec3 N = normalize(n);
    vec3 E = normalize(viewPos - world);
    float sum = 0;
    for (int i = 0; i < NB_LIGHTS; i++)
        sum += phong(lights[i], N, E);
    FragColor = vec4(materialColour * sum, 1);
}
