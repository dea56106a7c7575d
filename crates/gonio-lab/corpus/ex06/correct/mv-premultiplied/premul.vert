#version 330 core
in vec3 position;
in vec3 normal;
uniform mat4 MV;
uniform mat4 MVP;
out vec3 pe;
out vec3 ne;
void main()
{
    pe = (MV * vec4(position, 1.0)).xyz;
    ne = normalize(transpose(inverse(mat3(MV))) * normal);
    gl_Position = MVP * vec4(position, 1.0);
}
