#version 150
in vec3 a_Position;
in vec3 a_Normal;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM;
out vec3 pos;
out vec3 n;
// ------------
void main()
{
    pos = (M * vec4(a_Position, 1.0)).xyz;
    n = normalize((itM * vec4(a_Normal, 1.0)).xyz);
    gl_Position = P * M * V * vec4(a_Position, 1.0);
}
