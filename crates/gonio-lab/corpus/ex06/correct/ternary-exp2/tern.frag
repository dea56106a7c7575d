#version 460
layout(location = 0) in vec3 v_frag_coord;
layout(location = 1) in vec3 v_normal;
layout(location = 0) out vec4 FragColor;
uniform vec3 u_light_pos;
uniform vec3 u_view_pos;
uniform vec3 materialColour;
uniform float shininess;
float myPow(float b, float e) { return b > 0.0 ? exp2(e * log2(b)) : 0.0; }
void main()
{
    vec3 N = normalize(v_normal);
    vec3 L = normalize(u_light_pos - v_frag_coord);
    vec3 V = normalize(u_view_pos - v_frag_coord);
    float NL = dot(N, L);
    float diffuse = NL > 0.0 ? NL : 0.0;
    float specular = NL > 0.0 ? myPow(dot(reflect(-L, N), V), shininess) : 0.0;
    FragColor = vec4((diffuse + specular) * materialColour, 1.0);
}
