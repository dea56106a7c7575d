#version 330 core
in vec3 p3, n3;
uniform vec3 u_light_pos, materialColour;
out vec4 FragColor;
void main() {
    n3 = normalize(n3);
    vec3 incoming = normalize(p3 - u_light_pos);
    FragColor = vec4(max(-dot(normalize(n3), incoming), 0) * materialColour, 1);
}
