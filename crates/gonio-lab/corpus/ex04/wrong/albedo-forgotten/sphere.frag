#version 400 core
precision mediump float;
in vec3 normal_v;
in vec3 frag_pos;
out vec4 fragColor;
uniform vec3 u_light_pos;
uniform vec3 materialColour;
void main()
{
    vec3 N = normalize(normal_v);
    vec3 L = normalize(u_light_pos - frag_pos);
    float diffuse = max(dot(N, L), 0.0);
    fragColor = vec4(vec3(diffuse), 1.0);
}
