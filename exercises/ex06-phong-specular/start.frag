#version 330 core
// Exercise 06: Phong shading, specular. So far, there is no highlight at all.

uniform vec3 u_light_pos; // in the world
uniform vec3 u_view_pos;  // the camera's position in the world
uniform float shininess;  // the exponent

out vec4 FragColor;

void main() {
    // TODO: the four vectors of the specular term, here, per fragment. Which of them are new in every fragment?
    // TODO: the highlight.
    float specular = 0.0;
    FragColor = vec4(vec3(specular), 1.0);
}
