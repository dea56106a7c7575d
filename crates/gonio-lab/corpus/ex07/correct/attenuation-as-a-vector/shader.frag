#version 330 core
in vec3 FragPos;
in vec3 Normal;
out vec4 FragColor;
struct Light { vec3 position; vec3 ambient; vec3 diffuse; vec3 specular; vec3 attenuation; };
uniform Light light;
uniform vec3 viewPos;
uniform vec3 objectColor;
uniform float shininess;

void main()
{
    vec3 n = normalize(Normal);
    vec3 to_light = light.position - FragPos;
    float d = length(to_light);
    vec3 l = to_light / max(d, 1e-4);
    vec3 v = normalize(viewPos - FragPos);
    float fade = 1.0 / (light.attenuation.x + light.attenuation.y * d + light.attenuation.z * d * d);
    vec3 lit = light.diffuse * max(dot(n, l), 0.0) + light.specular * pow(max(dot(reflect(-l, n), v), 0.0), shininess);
    FragColor = vec4(objectColor * (light.ambient + fade * lit), 1.0);
}
