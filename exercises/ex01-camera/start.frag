#version 330 core
// Exercise 01: nothing to do here. The colour of the vertices, interpolated.

in vec3 v_col;
out vec4 FragColor;

void main() {
    FragColor = vec4(v_col, 1.0);
}
