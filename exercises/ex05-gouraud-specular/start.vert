#version 330 core
// Exercise 05: Gouraud shading, specular. So far, there is no highlight at all.

in vec3 position; // in model space
in vec2 tex_coord;
in vec3 normal; // in model space

uniform mat4 M;   // world from model
uniform mat4 itM; // the inverse transpose of M
uniform mat4 V;   // view from world
uniform mat4 P;   // clip from view
uniform vec3 u_light_pos; // in the world
uniform vec3 u_view_pos;  // the camera's position in the world
uniform float shininess;  // the exponent

out float v_specular;

void main() {
    vec4 frag_coord = M * vec4(position, 1.0);
    gl_Position = P * V * frag_coord;

    // TODO: N, L and V as unit vectors in one space. In which direction does each point?
    //       (V is already the name of a matrix here.)
    // TODO: the mirrored direction R.
    // TODO: how close is R to the direction of the eye? Make that the highlight.
    v_specular = 0.0;
}
