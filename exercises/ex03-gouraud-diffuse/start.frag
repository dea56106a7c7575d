#version 330 core
// Exercise 03: nothing to compute here. The light of the vertices, interpolated.

in float v_diffuse;
out vec4 FragColor;

void main() {
    FragColor = vec4(vec3(v_diffuse), 1.0);
}
