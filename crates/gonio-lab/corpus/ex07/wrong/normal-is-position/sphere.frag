#version 330 core
out vec4 FragColor;
in vec3 v_normal;
in vec3 v_frag_coord;
uniform vec3 camPos;
uniform struct Light {
    vec3 light_pos; float ambient_strength; float diffuse_strength; float specular_strength;
    float constant; float linear; float quadratic;
} light;
uniform vec3 materialColour;
void main()
{
    vec3 normal = normalize(v_normal);
    vec3 lightVec = light.light_pos - v_frag_coord;
    float dist = length(lightVec);
    float a = light.quadratic, b = light.linear, c = light.constant;
    float inten = 1.0f / (a * dist * dist + b * dist + c);
    float ambient = light.ambient_strength;
    vec3 lightDirection = normalize(lightVec);
    float diffuse = max(dot(normal, lightDirection), 0.0f);
    vec3 viewDirection = normalize(camPos - v_frag_coord);
    vec3 reflectionDirection = reflect(-lightDirection, normal);
    float specAmount = pow(max(dot(viewDirection, reflectionDirection), 0.0f), 32);
    float specular = specAmount * light.specular_strength;
    FragColor = vec4(materialColour * ((light.diffuse_strength * diffuse + specular) * inten + ambient), 1.0);
}
