#version 400 core
precision mediump float;
in vec3 v_normal;
in vec3 v_frag_coord;
out vec4 FragColor;
uniform vec3 u_light_pos;
uniform vec3 materialColour;
void main() {
    vec3 N = normalize(v_normal);
    vec3 L = normalize(u_light_pos - v_frag_coord);
    float diffuse = max(dot(N, L), 0.0);
    FragColor = vec4(materialColour * diffuse, 1.0);
}
