#version 330 core
in vec3 direction;

uniform samplerCube cubemapSampler;

out vec4 FragColor;

void main() {
    vec3 looked_up = direction;
    vec3 found = texture(cubemapSampler, looked_up).rgb;
    FragColor = vec4(found, 1.0);
}
