#version 330 core
// Exercise 08: what the cubemap holds in this direction.

in vec3 v_direction;

uniform samplerCube cubemapSampler;

out vec4 FragColor;

void main() {
    FragColor = vec4(texture(cubemapSampler, v_direction).rgb, 1.0);
}
