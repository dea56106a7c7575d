#version 330 core
// Exercise 10: refraction. So far, only the position is transformed.

in vec3 position; // in model space
in vec2 tex_coord;
in vec3 normal; // in model space

uniform mat4 M;   // world from model
uniform mat4 itM; // the inverse transpose of M
uniform mat4 V;   // view from world
uniform mat4 P;   // clip from view

void main() {
    vec4 frag_coord = M * vec4(position, 1.0);
    gl_Position = P * V * frag_coord;

    // TODO: what does the fragment shader need, and in which space is the cubemap?
}
