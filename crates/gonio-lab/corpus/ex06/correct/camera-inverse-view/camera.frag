#version 330 core
in vec3 pw, nw;
uniform mat4 V;
uniform vec3 u_light_pos, materialColour;
out vec4 FragColor;
void main() {
    vec3 cam = -transpose(mat3(V)) * V[3].xyz;   // camera position from the view matrix
    vec3 n = normalize(nw), l = normalize(u_light_pos - pw), e = normalize(cam - pw);
    float rv = max(dot(reflect(-l, n), e), 0.0);
    FragColor = vec4((max(dot(n, l), 0.0) + pow(rv, 32.0)) * materialColour, 1.0);
}
