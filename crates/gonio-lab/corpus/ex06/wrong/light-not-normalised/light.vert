#version 410 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec2 tex_coord;
layout(location = 2) in vec3 normal;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
out vec3 eye_pos;
out vec3 eye_normal;

void main()
{
    mat4 MV = V * M;
    eye_pos = (MV * vec4(position, 1.0)).xyz;
    mat3 N = mat3(transpose(inverse(MV)));
    eye_normal = normalize(N * normal);
    gl_Position = P * vec4(eye_pos, 1.0);
}
