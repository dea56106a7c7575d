#version 300 es
precision highp float;
precision highp samplerCube;
in vec3 v_normal;
in vec3 v_pos;
uniform samplerCube u_cubemap;
uniform vec3 u_view_pos;
out vec4 FragColor;
void main() {
    vec3 V = normalize(u_view_pos - v_pos);
    FragColor = vec4(texture(u_cubemap, reflect(-V, normalize(v_normal))).rgb, 1.0);
}
