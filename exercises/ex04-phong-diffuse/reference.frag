#version 330 core
// Exercise 04: the normal is interpolated, and the light computed here

in vec3 v_frag_coord; // in the world
in vec3 v_normal;     // in the world

uniform vec3 u_light_pos; // in the world

out vec4 FragColor;

void main() {
    // Interpolated unit vectors are shorter than 1.
    vec3 N = normalize(v_normal);
    vec3 L = normalize(u_light_pos - v_frag_coord);
    float diffuse = max(dot(N, L), 0.0);
    FragColor = vec4(vec3(diffuse), 1.0);
}
