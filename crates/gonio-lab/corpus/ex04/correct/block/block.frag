#version 440 core
in Surface
{
    vec3 position;
    vec3 normal;
} surface;
uniform vec3 lightPos;
uniform vec3 materialColour;
layout(location = 0) out vec4 FragColor;
void main()
{
    vec3 n = normalize(surface.normal);
    vec3 l = normalize(lightPos - surface.position);
    if (dot(n, l) < 0.0)
    {
        FragColor = vec4(vec3(0.0), 1.0);
        return;
    }
    FragColor = vec4(materialColour * dot(n, l), 1.0);
}
