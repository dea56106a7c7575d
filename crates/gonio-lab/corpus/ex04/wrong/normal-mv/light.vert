#version 300 es
in vec3 position;
in vec3 normal;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM;
out vec3 normal_v;
out vec3 frag_pos;
// TODO clean
void main()
{
    normal_v = normalize((V * M * vec4(normal, 0.0)).xyz);
    frag_pos = (M * vec4(position, 1.0)).xyz;
    gl_Position = P * V * vec4(frag_pos, 1.0);
}
