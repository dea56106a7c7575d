#version 330 core
in vec3 pe;
in vec3 ne;
uniform mat4 V;
uniform vec3 lightPos;
uniform vec3 materialColour;
out vec4 FragColor;
void main()
{
    vec3 n = normalize(ne);
    vec3 l = normalize(mat3(V) * lightPos + V[3].xyz - pe);
    vec3 v = normalize(-pe);
    float d = max(dot(n, l), 0.0);
    float s = pow(max(dot(l, v), 0.0), 32.0);
    FragColor = vec4(materialColour * (d + s), 1.0);
}
