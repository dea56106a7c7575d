#version 460 core

in vec3 vNormal;
in vec3 vWorldPos;
in vec3 vToLight;
in vec3 vToEye;

struct Light {
    vec3 light_pos;
    float ambient_strength;
    float diffuse_strength;
    float specular_strength;
    float constant;
    float linear;
    float quadratic;
};
uniform Light light;
uniform vec3 materialColour;

out vec4 FragColor;

void main()
{
    const float SHININESS = 32.0;
    vec3 n = normalize(vNormal);
    vec3 l = normalize(vToLight);
    vec3 e = normalize(vToEye);
    float r2 = dot(vToLight, vToLight);
    float r = sqrt(r2);

    float NdotL = dot(n, l);
    float diffuse = NdotL > 0.0 ? NdotL : 0.0;
    float RdotV = dot(2.0 * NdotL * n - l, e);
    float specular = RdotV > 0.0 ? pow(RdotV, SHININESS) : 0.0;

    float falloff = light.constant + light.linear * r + light.quadratic * r2;
    vec3 lit = vec3(light.diffuse_strength * diffuse + light.specular_strength * specular) / falloff;
    FragColor = vec4((vec3(light.ambient_strength) + lit) * materialColour, 1.0);
}
