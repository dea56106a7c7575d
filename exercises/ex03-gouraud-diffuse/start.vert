#version 330 core
// Exercise 03: Gouraud shading, diffuse. So far, every vertex is equally grey.

in vec3 position; // in model space
in vec2 tex_coord;
in vec3 normal; // in model space

uniform mat4 M;   // world from model
uniform mat4 itM; // the inverse transpose of M
uniform mat4 V;   // view from world
uniform mat4 P;   // clip from view
uniform vec3 u_light_pos; // in the world

out float v_diffuse;

void main() {
    vec4 frag_coord = M * vec4(position, 1.0);
    gl_Position = P * V * frag_coord;

    // TODO: the unit normal N in the world. By which matrix, and what must be done to its length afterwards?
    // TODO: the unit vector L, from this vertex to the light.
    // TODO: the diffuse term from N and L. What if the light is behind the surface?
    v_diffuse = 0.5;
}
