#version 330 core
in vec3 position;
in vec3 normal;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM;
out vec3 pos;
out vec3 nor;
flat out vec3 eye;
void main()
{
    pos = (M * vec4(position, 1.0)).xyz;
    nor = normalize(mat3(itM) * normal);
    eye = inverse(V)[3].xyz;
    gl_Position = P * V * M * vec4(position, 1.0);
}
