#version 150
in vec3 wn;
in vec3 wp;
uniform vec3 u_light_pos;
uniform vec3 materialColour;
out vec4 FragColor;
void main()
{
    vec3 n = wn * inversesqrt(dot(wn, wn));
    vec3 l = u_light_pos - wp;
    float c = dot(n, l) / length(l);
    FragColor = c > 0.0 ? vec4(c * materialColour, 1.0) : vec4(0.0, 0.0, 0.0, 1.0);
}
