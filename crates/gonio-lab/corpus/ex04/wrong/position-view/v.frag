#version 130
in vec3 p3, n3;
uniform vec3 u_light_pos, materialColour;
out vec4 frag_color;
void main() {
    vec3 incoming = normalize(p3 - u_light_pos);
    frag_color = vec4(max(-dot(normalize(n3), incoming), 0) * materialColour, 1);
}
