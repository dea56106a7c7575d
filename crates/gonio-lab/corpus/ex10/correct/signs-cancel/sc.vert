#version 460 core
in vec3 position;
in vec3 normal;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM;
out vec3 wp;
out vec3 wn;
void main()
{
    wp = (M * vec4(position, 1.0)).xyz;
    wn = normalize((itM * vec4(normal, 0.0)).xyz);
    gl_Position = P * V * vec4(wp, 1.0);
}
