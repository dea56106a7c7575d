#version 300 es
in vec3 position;
in vec3 normal;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM;
out vec3 v_normal;
out vec3 v_frag_coord;
void main() {
    v_normal = normalize((itM * vec4(normal, 0.0)).xyz);
    v_frag_coord = (M * vec4(position, 1.0)).xyz;
    gl_Position = P * V * vec4(v_frag_coord, 1.0);
}
