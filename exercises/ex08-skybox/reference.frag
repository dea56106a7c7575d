#version 330 core
// Exercise 08: the colour of the cubemap in this direction.

in vec3 v_direction;

uniform samplerCube cubemapSampler;

out vec4 FragColor;

void main() {
    FragColor = vec4(texture(cubemapSampler, v_direction).rgb, 1.0);
}
