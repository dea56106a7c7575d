#version 330 core
// Exercise 10: refraction. So far, the whole object shows a single texel of the cubemap.

uniform samplerCube cubemapSampler;
uniform vec3 u_view_pos;        // the camera's position in the world
uniform float refractionIndice; // of the object: glass 1.52

out vec4 FragColor;

void main() {
    // TODO: the unit normal, and the unit vector to the eye.
    // TODO: the ratio of the two refractive indices. Which one is divided by which?
    // TODO: the refracted direction. What if there is none?
    vec3 direction = vec3(0.0, 0.0, -1.0);
    FragColor = vec4(texture(cubemapSampler, direction).rgb, 1.0);
}
