#version 460 core
in vec3 position;
in vec3 normal;
in vec2 tex_coord;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM;
out vec3 v_frag_coord;
out vec3 v_normal;


void main()
{
    v_frag_coord = vec3(M * vec4(position, 1.0));
    v_normal = normalize(mat3(itM) * normal);
    gl_Position = P * V * M * vec4(position, 1.0);
}
