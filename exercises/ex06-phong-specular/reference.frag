#version 330 core
// Exercise 06: the highlight of each fragment

in vec3 v_frag_coord; // in the world
in vec3 v_normal;     // in the world

uniform vec3 u_light_pos; // in the world
uniform vec3 u_view_pos;  // the camera's position in the world
uniform float shininess;  // the exponent

out vec4 FragColor;

void main() {
    vec3 N = normalize(v_normal);
    vec3 L = normalize(u_light_pos - v_frag_coord);
    vec3 V = normalize(u_view_pos - v_frag_coord);
    // R = 2 (N.L) N - L
    vec3 R = reflect(-L, N);
    float specular = pow(max(dot(R, V), 0.0), shininess);
    FragColor = vec4(vec3(specular), 1.0);
}
