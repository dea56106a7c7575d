#version 410 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
out vec3 e;
out vec3 ne;
void main()
{
    mat4 MV = V * M;
    e = (MV * vec4(position, 1.0)).xyz;
    ne = normalize(mat3(transpose(inverse(MV))) * normal);
    gl_Position = P * vec4(e, 1.0);
}
