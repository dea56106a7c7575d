#version 330 core
// Rim light: the vertex shader of Phong shading.

in vec3 position; // in model space
in vec3 normal;   // in model space

uniform mat4 M;   // world from model
uniform mat4 itM; // the inverse transpose of M
uniform mat4 V;   // view from world
uniform mat4 P;   // clip from view

out vec3 v_place;  // in the world
out vec3 v_normal; // in the world

void main() {
    vec4 place = M * vec4(position, 1.0);
    gl_Position = P * V * place;
    v_place = place.xyz;
    // TODO: the normal, in the world.
    v_normal = normal;
}
