#version 330 core
// Exercise 04: Phong shading, diffuse. So far, every fragment is equally grey.

in vec3 v_frag_coord; // in the world

uniform vec3 u_light_pos; // in the world

out vec4 FragColor;

void main() {
    // TODO: receive what the vertex shader sends. What has interpolation done to it?
    // TODO: the unit vector L, from this fragment to the light.
    // TODO: the diffuse term.
    float diffuse = 0.5;
    FragColor = vec4(vec3(diffuse), 1.0);
}
