#version 330 core
// Exercise 01: the camera. So far, the view matrix is the identity and only M is used:
// the pyramid sits flat in the middle of the picture and nothing happens when the camera moves.

in vec3 position; // in model space
in vec3 color;

uniform mat4 M; // world from model
uniform mat4 P; // clip from view
uniform vec3 u_view_pos; // the camera's position in the world
uniform vec3 u_front;    // where it looks, unit length, in the world
uniform vec3 u_up;       // roughly upwards, unit length; not always perpendicular to u_front

out vec3 v_col;

// The matrix that takes a point from the world to the camera's own space.
mat4 view_matrix(vec3 eye, vec3 front, vec3 up) {
    // TODO: find the camera's three axes, and mind the length of each.
    // TODO: build the matrix from them and from eye. What does mat4(...) take first: a row or a column?
    return mat4(1.0);
}

void main() {
    mat4 V = view_matrix(u_view_pos, u_front, u_up);
    v_col = color;
    // TODO: which matrices does a point go through, and in which order?
    gl_Position = M * vec4(position, 1.0);
}
