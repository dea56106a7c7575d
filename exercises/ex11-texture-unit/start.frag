#version 330 core
// Exercise 11: the black triangle. This shader is right; the mistake is in the GL program.

in vec3 v_col;
in vec2 v_tex;

uniform sampler2D ourTexture;

out vec4 FragColor;

void main() {
    FragColor = texture(ourTexture, v_tex) * vec4(v_col, 1.0);
}
