#version 330 core
in vec3 FragPos;
in vec3 Normal;
uniform vec3 lightPos;
uniform vec3 viewPos;
uniform vec3 materialColour;
uniform float shininess;
out vec4 FragColor;
void main() {
    vec3 n = normalize(Normal);
    vec3 l = normalize(lightPos - FragPos);
    vec3 v = normalize(viewPos - FragPos);
    vec3 h = normalize(l + v);
    FragColor = vec4(materialColour * (max(dot(n, l), 0.0) + pow(max(dot(n, h), 0.0), shininess)), 1.0);
}
