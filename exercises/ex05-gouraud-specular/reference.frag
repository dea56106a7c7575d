#version 330 core
// Exercise 05: the highlight of the vertices, interpolated

in float v_specular;
out vec4 FragColor;

void main() {
    FragColor = vec4(vec3(v_specular), 1.0);
}
