#version 300 es
in vec3 position;
in vec3 normal;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM;
uniform vec3 u_light_pos;
uniform vec3 materialColour;
out vec3 v_col;
void main() {
    u_light_pos = vec3(0.5, 0.5, -0.7);
    vec4 w = M * vec4(position, 1.0);
    vec3 n = normalize(mat3(itM) * normal);
    vec3 l = normalize(u_light_pos - w.xyz);
    v_col = materialColour * max(dot(n, l), 0.0);
    gl_Position = P * V * w;
}
