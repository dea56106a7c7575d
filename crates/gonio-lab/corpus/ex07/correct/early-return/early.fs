#version 330 core

in vec3 fragPos;
in vec3 fragNormal;

out vec4 outColor;

struct Light
{
    vec3 light_pos;
    float ambient_strength;
    float diffuse_strength;
    float specular_strength;
    float constant;
    float linear;
    float quadratic;
};

uniform Light light;
uniform vec3 viewPos;
uniform float shininess = 32.0f;
uniform vec3 materialColour;

vec3 shade()
{
    vec3 ambient = light.ambient_strength * materialColour;
    vec3 n = normalize(fragNormal);
    vec3 l = light.light_pos - fragPos;
    float d = length(l);
    l = normalize(l);
    float cosine = dot(n, l);

    // the light does not see this point
    if (cosine <= 0.0f)
        return ambient;

    vec3 v = normalize(viewPos - fragPos);
    float s = pow(max(dot(reflect(-l, n), v), 0.0f), shininess);
    float att = 1.0f / (light.constant + light.linear * d + light.quadratic * d * d);
    return ambient + att * (light.diffuse_strength * cosine + light.specular_strength * s) * materialColour;
}

void main()
{
    outColor = vec4(shade(), 1.0f);
}
