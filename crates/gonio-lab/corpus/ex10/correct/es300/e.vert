#version 300 es
in vec3 position;
in vec3 normal;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM;
out vec3 v_normal;
out vec3 v_pos;
void main() {
    vec4 w = M * vec4(position, 1.0);
    v_pos = w.xyz;
    v_normal = normalize(mat3(itM) * normal);
    gl_Position = P * V * w;
}
