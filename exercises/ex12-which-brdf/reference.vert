#version 330 core
// Exercise 12: which BRDF?

in vec3 position; // in model space
in vec2 tex_coord;
in vec3 normal; // in model space

uniform mat4 M;   // world from model
uniform mat4 itM; // the inverse transpose of M
uniform mat4 V;   // view from world
uniform mat4 P;   // clip from view

out vec3 v_frag_coord; // in the world
out vec3 v_normal;     // in the world

void main() {
    vec4 frag_coord = M * vec4(position, 1.0);
    gl_Position = P * V * frag_coord;
    v_frag_coord = frag_coord.xyz;
    v_normal = normalize(mat3(itM) * normal);
}
