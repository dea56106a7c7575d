#version 330 core
// Exercise 08: the skybox. So far it outputs plain blue.

uniform samplerCube cubemapSampler;

out vec4 FragColor;

void main() {
    // TODO: sample the cubemap in the direction that the vertex shader sends.
    FragColor = vec4(0.1, 0.2, 0.4, 1.0);
}
