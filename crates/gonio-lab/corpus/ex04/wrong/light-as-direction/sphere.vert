#version 130
in vec3 position;
in vec3 normal;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM;
out vec3 normal_v;
out vec3 v_pos;
// TODO clean
void main() {
    normal_v = normalize(vec3(itM * vec4(normal, 0.0)));
    v_pos = vec3(M * vec4(position, 1.0));
    gl_Position = P * V * M * vec4(position, 1.0);
}
