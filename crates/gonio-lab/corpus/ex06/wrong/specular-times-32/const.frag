#version 460 core
const vec3  AMBIENT  = vec3(0.05, 0.05, 0.1);
const float DIFFUSE  = 0.7;
const float SPECULAR = 0.4;
const float EXPONENT = 32.0;
in vec3 v_frag_coord;
in vec3 v_normal;
uniform vec3 u_light_pos;
uniform vec3 u_view_pos;
uniform vec3 materialColour;
out vec4 outColor;
void main()
{
    vec3 n = normalize(v_normal);
    vec3 l = normalize(u_light_pos - v_frag_coord);
    vec3 v = normalize(u_view_pos - v_frag_coord);
    vec3 light = AMBIENT;
    light += DIFFUSE * max(dot(n, l), 0.0);
    light += SPECULAR * max(dot(reflect(-l, n), v), 0.0) * EXPONENT;
    outColor = vec4(light * materialColour, 1.0);
}
