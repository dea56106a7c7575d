#version 400 core
out vec4 FragColor;
precision mediump float;
in vec3 v_frag_coord;
in vec3 v_normal;
uniform vec3 u_view_pos;
uniform samplerCube cubemapSampler;
// TODO clean
void main()
{
    vec3 N = normalize(v_normal);
    vec3 view = normalize(u_view_pos - v_frag_coord);
    vec3 R = reflect(-view, N);
    FragColor = vec4(N, 1.0);
}
