#version 460 core
in vec3 v_frag_coord;
in vec3 v_normal;
uniform vec3 u_light_pos;
uniform vec3 u_view_pos;
uniform vec3 materialColour;
uniform float shininess;
out vec4 outColor;



void main()
{
    vec3 N = normalize(v_normal);
    vec3 L = normalize(u_light_pos - v_frag_coord);
    vec3 V = normalize(u_view_pos - v_frag_coord);
    vec3 R = reflect(-L, N);


    float diffuse = max(dot(N, L), 0.0);
    float specular = pow(max(dot(R, V), 0.0), shininess);


    outColor = vec4(N, 1.0);
}
