#version 440
#define NB_LIGHTS 1

struct Light {
    vec3 light_pos;
    float ambient_strength, diffuse_strength, specular_strength;
    float constant, linear, quadratic;
};
uniform Light lights[NB_LIGHTS];
uniform vec3 u_view_pos;
uniform vec3 materialColour;
uniform float shininess;

in vec3 world; in vec3 n;
out vec4 color_out;

float phong(Light li, vec3 N, vec3 E)
{
    vec3 L = li.light_pos - world;
    float d = length(L);
    L /= d;
    float att = 1 / (li.constant + li.linear * d + li.quadratic * d * d);
    float dif = li.diffuse_strength * max(dot(N, L), 0);
    float spe = li.specular_strength * pow(max(dot(reflect(-L, N), E), 0), shininess);
    return li.ambient_strength + att * (dif + spe);
}

void main()
{
    vec3 E = normalize(u_view_pos - world);
    float sum = 0;
    for (int i = 0; i < NB_LIGHTS; i++)
        sum += phong(lights[i], n, E);
    color_out = vec4(materialColour * sum, 1);
}
