#version 330 core
in vec3 v_normal;
in vec3 v_frag_coord;
uniform vec3 u_light_pos, u_view_pos, materialColour;
out vec4 FragColor;
void main() {
    vec3 N = normalize(v_normal);
    vec3 L = normalize(u_light_pos - v_frag_coord);
    vec3 V = normalize(u_view_pos - v_frag_coord);
    FragColor = vec4(materialColour * (max(dot(N, L), 0.0) + pow(max(dot(reflect(-L, N), V), 0.0), 32.0)), 1.0);
}
