#version 330 core
// The camera, from its position, its direction and a rough up vector.
in vec3 position;
in vec3 color;

uniform mat4 M;
uniform mat4 P;
uniform vec3 u_view_pos;
uniform vec3 u_front;
uniform vec3 u_up;

out vec3 v_col;

void main() {
    vec3 front = normalize(u_front);
    vec3 across = cross(front, u_up);
    vec3 right = normalize(across);
    vec3 up = cross(right, front);
    vec3 back = -front;
    mat3 axes = mat3(right, up, back); // the columns of the camera's own matrix
    mat3 turn = transpose(axes);
    vec3 moved = -u_view_pos;
    vec3 shift = moved * axes; // three dot products
    mat4 V = mat4(vec4(turn[0], 0.0), vec4(turn[1], 0.0), vec4(turn[2], 0.0), vec4(shift, 1.0));
    vec4 place = vec4(position, 1.0);
    vec4 world_place = M * place;
    vec4 clip = P * V * world_place;
    v_col = color;
    gl_Position = clip;
}
