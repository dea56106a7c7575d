#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec2 tex_coords;
layout(location = 2) in vec3 normal;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM;
out vec3 world_pos;
out vec3 world_n;


void main()
{
    world_pos = vec3(M * vec4(position, 1.0));
    world_n = normalize(mat3(itM) * normal);
    gl_Position = P * V * vec4(position, 1.0);
}
