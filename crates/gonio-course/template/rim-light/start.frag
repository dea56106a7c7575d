#version 330 core
// Rim light. So far, one flat colour.

in vec3 v_place;  // in the world
in vec3 v_normal; // in the world

uniform vec3 light_pos;  // in the world
uniform vec3 u_view_pos; // the camera's position in the world
uniform vec3 materialColour;
uniform float diffuse_strength;
uniform float rim_strength;
uniform float rim_exponent;

out vec4 FragColor;

void main() {
    // TODO: the diffuse light.
    // TODO: the rim. Which cosine is 0 at the outline, and 1 in the middle?
    FragColor = vec4(materialColour, 1.0);
}
