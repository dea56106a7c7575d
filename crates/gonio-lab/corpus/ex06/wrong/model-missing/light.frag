#version 330 core
in vec3 world_pos;
in vec3 world_n;
uniform vec3 u_light_pos;
uniform vec3 camPos;
uniform vec3 materialColour;
out vec4 frag_color;


void main()
{
    vec3 n = normalize(world_n);
    vec3 l = normalize(u_light_pos - world_pos);
    vec3 v = normalize(camPos - world_pos);
    vec3 d = materialColour * max(dot(n, l), 0.0);
    vec3 s = materialColour * pow(max(dot(v, reflect(-l, n)), 0.0), 32.0);
    frag_color = vec4(d + s, 1.0);
}
