#version 330 core
in vec3 worldPosition;
in vec3 normal;
out vec4 FragColor;
uniform vec3 lightPosition;

void main() {
    float cosine = dot(normalize(normal), normalize(lightPosition - worldPosition));
    FragColor = vec4(vec3(max(cosine, 0.0)), 1.0);
}
