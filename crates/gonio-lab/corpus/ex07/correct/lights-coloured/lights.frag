#version 330 core
in vec3 v_frag_coord;
in vec3 v_normal;
uniform vec3 lightPos[2];
uniform vec3 lightColor[2];
uniform vec3 u_view_pos;
uniform vec3 materialColour;
uniform float shininess;
out vec4 FragColor;
void main() {
    vec3 N = normalize(v_normal);
    vec3 V = normalize(u_view_pos - v_frag_coord);
    vec3 light = vec3(0.1);
    for (int i = 0; i < 2; i++) {
        vec3 L = normalize(lightPos[i] - v_frag_coord);
        float d = length(lightPos[i] - v_frag_coord);
        float att = 1.0 / (1.0 + 0.14 * d + 0.07 * d * d);
        light += lightColor[i] * att * (0.5 * max(dot(N, L), 0.0) + 0.8 * pow(max(dot(reflect(-L, N), V), 0.0), shininess));
    }
    FragColor = vec4(materialColour * light, 1.0);
}
