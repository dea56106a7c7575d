#version 330 core
// Exercise 01: the camera

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
    vec3 z_axis = -normalize(front);
    vec3 x_axis = normalize(cross(up, z_axis));
    vec3 y_axis = cross(z_axis, x_axis);
    // mat4 takes columns: the axes are the rows of the rotation.
    return mat4(
        vec4(x_axis.x, y_axis.x, z_axis.x, 0.0),
        vec4(x_axis.y, y_axis.y, z_axis.y, 0.0),
        vec4(x_axis.z, y_axis.z, z_axis.z, 0.0),
        vec4(-dot(x_axis, eye), -dot(y_axis, eye), -dot(z_axis, eye), 1.0)
    );
}

void main() {
    mat4 V = view_matrix(u_view_pos, u_front, u_up);
    v_col = color;
    gl_Position = P * V * M * vec4(position, 1.0);
}
