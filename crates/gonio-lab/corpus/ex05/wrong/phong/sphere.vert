#version 330 core
in vec3 position;
in vec3 normal;
uniform mat4 M, V, P, itM;
out vec3 v_normal;
out vec3 v_frag_coord;
void main() {
    vec4 w = M * vec4(position, 1.0);
    v_frag_coord = w.xyz;
    v_normal = normalize(vec3(itM * vec4(normal, 0.0)));
    gl_Position = P * V * w;
}
