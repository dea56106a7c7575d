#version 300 es
precision highp float;
in vec3 v_world;
in vec3 v_n;
uniform vec3 u_light_pos;
uniform vec3 u_view_pos;
uniform vec3 materialColour;
uniform float shininess;
layout(location = 0) out vec4 FragColor;
void main() {
    vec3 N = v_n;
    vec3 L = normalize(u_light_pos - v_world);
    vec3 V = normalize(u_view_pos - v_world);
    float diffuse = max(dot(N, L), 0.0);
    float specular = pow(max(dot(reflect(-L, N), V), 0.0), shininess);
    FragColor = vec4(materialColour * (diffuse + specular), 1.0);
}
