#version 300 es
precision highp float;
in vec3 v_n;
in vec3 v_pos;
uniform samplerCube u_cubemap;
uniform vec3 u_view_pos;
uniform float refractionIndice;
out vec4 FragColor;
void main() {
    vec3 V = normalize(u_view_pos - v_pos);
    vec3 T = reflect(-V, normalize(v_n));
    FragColor = vec4(texture(u_cubemap, T).rgb, 1.0);
}
