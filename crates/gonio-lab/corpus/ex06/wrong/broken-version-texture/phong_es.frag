#version 300 es
precision highp float;
in vec3 v_frag_coord;
in vec3 v_normal;
uniform vec3 u_light_pos;
uniform vec3 u_view_pos;
uniform vec3 materialColour;
uniform float shininess;
uniform sampler2D u_texture;
layout(location = 0) out vec4 FragColor;
void main() {
    vec3 N = normalize(v_normal);
    vec3 L = normalize(u_light_pos - v_frag_coord);
    vec3 V = normalize(u_view_pos - v_frag_coord);
    float diffuse = max(dot(N, L), 0.0);
    float specular = pow(max(dot(reflect(-L, N), V), 0.0), shininess);
    FragColor = texture2D(u_texture, vec2(0.5)) * (diffuse + specular);
}
