#version 150
in vec3 position;
in vec3 normal;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM;
out vec3 pos;
out vec3 n;
void main()
{
    pos = (M * vec4(position, 1.0)).xyz;
    n = normalize((itM * vec4(normal, 1.0)).xyz);
    gl_Position = P * V * M * vec4(position, 1.0);
}
