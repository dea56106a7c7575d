#version 330 core
in vec3 aPos;
in vec2 tex_coords;
in vec3 aNormal;
out vec3 v_frag_coord;
out vec3 v_normal;
uniform mat4 model;
uniform mat4 itM;
uniform mat4 view;
uniform mat4 projection;
// TODO clean
void main()
{
    vec4 frag_coord = model*vec4(aPos, 1.0);
    gl_Position = projection*view*frag_coord;
    v_normal = normalize(vec3(model * vec4(aNormal, 1.0)));
    v_frag_coord = frag_coord.xyz;
}
