#version 330 core
// Exercise 08: the skybox. As it stands, a plain blue.

uniform samplerCube cubemapSampler;

out vec4 FragColor;

void main() {
    // TODO: look up the cubemap in the direction that the vertex shader sends.
    FragColor = vec4(0.1, 0.2, 0.4, 1.0);
}
