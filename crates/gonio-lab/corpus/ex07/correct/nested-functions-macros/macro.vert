#version 330 core
in vec3 position;
in vec3 normal;
uniform mat4 M; uniform mat4 V; uniform mat4 P;
out vec3 v_frag_coord;
out vec3 v_normal;
#define TO_WORLD(p) (M * vec4((p), 1.0)).xyz
void main()
{
    mat3 itM3 = transpose(inverse(mat3(M)));
    v_frag_coord = TO_WORLD(position);
    v_normal = normalize(itM3 * normal);
    gl_Position = P * V * vec4(v_frag_coord, 1.0);
}
