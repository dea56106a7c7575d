#version 300 es
precision mediump float;
in vec3 normal_v;
in vec3 frag_pos;
uniform vec3 u_light_pos;
uniform vec3 materialColour;
out vec4 fragColor;
// TODO clean
void main()
{
    vec3 n = normalize(normal_v);
    vec3 l = normalize(u_light_pos - frag_pos);
    fragColor = vec4(materialColour * max(dot(n, l), 0.0), 1.0);
}
