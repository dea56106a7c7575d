#version 330 core
in vec3 FragPos;
in vec3 Normal;
out vec4 FragColor;
uniform vec3 lightDir;
uniform vec3 viewPos;

void main()
{
    vec3 n = normalize(Normal);
    vec3 l = normalize(-lightDir);
    vec3 v = normalize(viewPos - FragPos);
    float spec = pow(max(dot(reflect(-l, n), v), 0.0), 32.0);
    FragColor = vec4(vec3(0.1 + max(dot(n, l), 0.0) + 0.8 * spec), 1.0);
}
