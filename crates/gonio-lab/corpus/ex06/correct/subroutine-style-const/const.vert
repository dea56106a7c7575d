#version 330 core
layout (location = 0) in vec3 position;
layout (location = 2) in vec3 normal;
uniform mat4 M; uniform mat4 V; uniform mat4 P; uniform mat4 itM;
out vec3 v_frag_coord;
out vec3 v_normal;
void main()
{
    v_frag_coord = (M * vec4(position, 1.0)).xyz;
    v_normal = normalize((itM * vec4(normal, 0.0)).xyz);
    gl_Position = (P * V) * vec4(v_frag_coord, 1.0);
}
