#version 330 core
// Exercise 09: reflection

in vec3 v_frag_coord; // in the world
in vec3 v_normal;     // in the world

uniform samplerCube cubemapSampler;
uniform vec3 u_view_pos; // the camera's position in the world

out vec4 FragColor;

void main() {
    vec3 N = normalize(v_normal);
    vec3 V = normalize(u_view_pos - v_frag_coord);
    // GLSL's reflect expects the incident direction, -V. The formula is R = 2 (N.V) N - V.
    vec3 R = reflect(-V, N);
    FragColor = vec4(texture(cubemapSampler, R).rgb, 1.0);
}
