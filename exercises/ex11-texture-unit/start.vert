#version 330 core
// Exercise 11: the black triangle. This shader is right; the mistake is in the GL program.

in vec3 position; // in clip space already
in vec3 color;
in vec2 tex_coord;

out vec3 v_col;
out vec2 v_tex;

void main() {
    v_col = color;
    v_tex = tex_coord;
    gl_Position = vec4(position, 1.0);
}
