#version 410 core
in vec3 position;
in vec3 normal;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM;
out vec3 v_normal;
out vec3 v_pos;
void main() {
    v_normal = normalize(position);
    v_pos = vec3(M * vec4(position, 1.0));
    gl_Position = P * V * M * vec4(position, 1.0);
}
