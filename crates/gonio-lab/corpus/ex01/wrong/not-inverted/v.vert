#version 330 core
in vec3 position;
in vec3 color;
uniform mat4 M;
uniform mat4 P;
uniform vec3 u_view_pos;
uniform vec3 u_front;
uniform vec3 u_up;
out vec3 v_col;
void main() {
    vec3 z = -u_front;
    vec3 x = normalize(cross(u_up, z));
    vec3 y = cross(z, x);
    mat4 camera = mat4(vec4(x, 0.0), vec4(y, 0.0), vec4(z, 0.0), vec4(u_view_pos, 1.0));
    mat4 V = camera;
    gl_Position = P * V * M * vec4(position, 1.0);
    v_col = color;
}
