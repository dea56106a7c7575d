#version 330 core
in vec3 position;

uniform mat4 V;
uniform mat4 P;

out vec3 direction;

void main() {
    mat4 turn = mat4(mat3(V));
    direction = position;
    vec3 turned = (turn * vec4(position, 1.0)).xyz;
    vec4 place = P * vec4(turned, 1.0);
    gl_Position = place.xyww;
}
