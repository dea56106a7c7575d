#version 330 core
// Exercise 05: Gouraud shading, specular

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

    vec3 N = normalize(mat3(itM) * normal);
    vec3 L = normalize(u_light_pos - frag_coord.xyz);
    vec3 to_eye = normalize(u_view_pos - frag_coord.xyz);
    // R = 2 (N.L) N - L
    vec3 R = reflect(-L, N);
    v_specular = pow(max(dot(R, to_eye), 0.0), shininess);
}
