#version 440 core
layout(location = 0) in vec3 aPos;
layout(location = 2) in vec3 aNormal;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM;
out Surface
{
    vec3 position;
    vec3 normal;
} surface;
// TODO clean
void main()
{
    surface.position = (M * vec4(aPos, 1.0)).xyz;
    surface.normal = aNormal;
    gl_Position = P * V * M * vec4(aPos, 1.0);
}
