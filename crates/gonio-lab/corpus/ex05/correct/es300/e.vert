#version 300 es
in vec3 position;
in vec3 normal;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM;
uniform vec3 u_light_pos;
uniform vec3 u_view_pos;
uniform float shininess;
out float v_diffuse;
out float v_specular;
void main() {
    vec4 w = M * vec4(position, 1.0);
    vec3 n = normalize(mat3(itM) * normal);
    vec3 l = normalize(u_light_pos - w.xyz);
    vec3 v = normalize(u_view_pos - w.xyz);
    v_diffuse = max(dot(n, l), 0.0);
    v_specular = pow(max(dot(reflect(-l, n), v), 0.0), shininess);
    gl_Position = P * V * w;
}
