#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
uniform mat4 model, view, projection;
uniform mat4 itM;
out vec3 v_normal;
out vec3 v_frag_coord;
void main()
{
    v_normal = normalize(mat3(itM) * position);
    v_frag_coord = (model * vec4(position, 1.0)).xyz;
    gl_Position = projection * view * model * vec4(position, 1.0);
}
