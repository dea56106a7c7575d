#version 330 core
// Exercise 05: nothing to compute here. The highlight of the vertices, interpolated.

in float v_specular;
out vec4 FragColor;

void main() {
    FragColor = vec4(vec3(v_specular), 1.0);
}
