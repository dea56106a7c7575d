#version 330 core
// Exercise 06: Phong shading, specular. So far, only the position is transformed.

in vec3 position; // in model space
in vec2 tex_coord;
in vec3 normal; // in model space

uniform mat4 M;   // world from model
uniform mat4 itM; // the inverse transpose of M
uniform mat4 V;   // view from world
uniform mat4 P;   // clip from view

void main() {
    // TODO: what has to leave this shader, so that the fragment shader can do the rest?
    gl_Position = P * V * M * vec4(position, 1.0);
}
