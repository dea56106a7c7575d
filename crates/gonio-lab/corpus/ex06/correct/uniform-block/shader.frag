#version 330 core
in vec3 FragPos;
in vec3 Normal;
out vec4 FragColor;
uniform Lamp {
    vec3 lightPos;
    vec3 lightColor;
} lamp;
uniform vec3 viewPos;

void main()
{
    vec3 n = normalize(Normal);
    vec3 l = normalize(lamp.lightPos - FragPos);
    vec3 v = normalize(viewPos - FragPos);
    float spec = pow(max(dot(reflect(-l, n), v), 0.0), 32.0);
    FragColor = vec4(lamp.lightColor * (0.1 + max(dot(n, l), 0.0) + 0.5 * spec), 1.0);
}
