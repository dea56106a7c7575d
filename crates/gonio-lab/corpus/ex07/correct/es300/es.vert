#version 300 es
precision highp float;
in vec3 position;
in vec3 normal;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM;
out vec3 v_frag_coord;
out vec3 v_normal;
void main() {
    vec4 frag_coord = M * vec4(position, 1.0);
    gl_Position = P * V * frag_coord;
    v_normal = normalize(vec3(itM * vec4(normal, 0.0)));
    v_frag_coord = frag_coord.xyz;
}
