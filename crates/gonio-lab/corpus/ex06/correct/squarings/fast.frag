#version 330 core
in vec3 P3, N3;
uniform vec3 u_light_pos, u_view_pos, materialColour;
out vec4 c;
void main() {
    vec3 n = normalize(N3), l = normalize(u_light_pos - P3), v = normalize(u_view_pos - P3);
    float s = max(0.0, dot(2.0 * dot(l, n) * n - l, v));
    s *= s; s *= s; s *= s; s *= s; s *= s; // ^32
    c = vec4((max(0.0, dot(n, l)) + s) * materialColour, 1.0);
}
