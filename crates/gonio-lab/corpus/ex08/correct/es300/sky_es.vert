#version 300 es
in vec3 position;
uniform mat4 V;
uniform mat4 P;
out vec3 v_tex;
void main() {
    v_tex = position;
    vec4 p = P * vec4(mat3(V) * position, 1.0);
    gl_Position = p;
    gl_Position.z = gl_Position.w;
}
