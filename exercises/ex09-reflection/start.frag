#version 330 core
// Exercise 09: reflection. So far, the whole object shows a single texel of the cubemap.

uniform samplerCube cubemapSampler;
uniform vec3 u_view_pos; // the camera's position in the world

out vec4 FragColor;

void main() {
    // TODO: the unit normal, and the unit vector to the eye.
    // TODO: the mirrored direction. Check which way the vectors point in the formula that you use.
    vec3 direction = vec3(0.0, 0.0, -1.0);
    FragColor = vec4(texture(cubemapSampler, direction).rgb, 1.0);
}
