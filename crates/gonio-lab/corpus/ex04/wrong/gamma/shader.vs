#version 330 core
in vec3 position;
in vec2 tex_coords;
in vec3 normal;
out vec3 normal_v;
out vec3 frag_pos;
uniform mat4 M;
uniform mat4 itM;
uniform mat4 V;
uniform mat4 P;
void main()
{
    vec4 frag_coord = M*vec4(position, 1.0);
    gl_Position = P*V*frag_coord;
    normal_v = normalize(vec3(itM * vec4(normal, 1.0)));
    frag_pos = frag_coord.xyz;
}
