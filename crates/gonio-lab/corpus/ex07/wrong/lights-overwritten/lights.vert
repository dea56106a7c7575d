#version 330 core
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
    v_normal = normalize(mat3(itM) * normal);
    v_frag_coord = frag_coord.xyz;
}
