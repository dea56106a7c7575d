#version 330 core
in vec3 position; // in the model's own space
in vec3 color;

uniform mat4 M; // world from model
uniform mat4 P; // clip from view
uniform vec3 u_view_pos;
uniform vec3 u_front;
uniform vec3 u_up;

out vec3 v_col;

mat4 view_matrix(vec3 eye, vec3 front, vec3 up) {
    vec3 right = normalize(cross(front, up));
    vec3 newUp = cross(right, front);
    return mat4(
        right.x, newUp.x, -front.x, 0.0,
        right.y, newUp.y, -front.y, 0.0,
        right.z, newUp.z, -front.z, 0.0,
        -dot(right, eye), -dot(newUp, eye), dot(front, eye), 1.0
    );
}

void main() {
    mat4 V = view_matrix(u_view_pos, u_front, u_up);
    v_col = color;
    gl_Position = P * V * M * vec4(position, 1.0);
}
