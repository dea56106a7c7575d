#version 330 core
in vec3 position;
in vec3 normal;
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
