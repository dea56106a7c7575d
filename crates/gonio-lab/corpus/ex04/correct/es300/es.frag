#version 300 es
precision mediump float;
in vec3 v_normal;
in vec3 v_frag_coord;
uniform vec3 u_light_pos;
uniform vec3 materialColour;
out vec4 FragColor;
void main() {
    vec3 n = normalize(v_normal);
    vec3 l = normalize(u_light_pos - v_frag_coord);
    FragColor = vec4(materialColour * max(dot(n, l), 0.0), 1.0);
}
