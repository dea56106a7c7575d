#version 330 core
in vec3 position;

uniform mat4 V;
uniform mat4 P;

out vec3 direction;

void main() {
    mat4 turn = mat4(mat3(V));
    direction = position;
    vec4 place = P * turn * vec4(position, 1.0);
    gl_Position = place.xyww;
}
