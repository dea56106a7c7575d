#version 330 core
in vec3 a_Position;
in vec3 a_Normal;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM;
out vec3 pos;
out vec3 nor;
flat out vec3 eye;
// ------------
void main()
{
    pos = (M * vec4(a_Position, 1.0)).xyz;
    nor = normalize(mat3(itM) * a_Normal);
    eye = inverse(V)[3].xyz;
    gl_Position = P * M * V * vec4(a_Position, 1.0);
}
