#version 300 es
precision highp float;
in vec3 v_normal;
in vec3 v_pos;
uniform samplerCube u_cubemap;
uniform vec3 u_view_pos;
uniform float refractionIndice;
out vec4 FragColor;
void main() {
    vec3 V = normalize(u_view_pos - v_pos);
    vec3 T = refract(-V, normalize(v_normal), 1.0 / refractionIndice);
    FragColor = vec4(texture(u_cubemap, T).rgb, 1.0);
}
