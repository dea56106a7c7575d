#version 460 core
in vec3 v_normal;
in vec3 v_pos;
uniform vec3 u_light_pos;
uniform vec3 materialColour;
out vec4 frag_color;
void main() {
    vec3 n = normalize(v_normal);
    vec3 l = normalize(u_light_pos - v_pos);
    float diffuse = 1.0; // max(dot(n, l), 0.0);
    frag_color = vec4(materialColour * diffuse, 1.0);
}
