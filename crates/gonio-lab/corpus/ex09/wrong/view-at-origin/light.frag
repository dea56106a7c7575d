#version 300 es
precision highp float;
precision highp samplerCube;
in vec3 n;
in vec3 v_pos;
uniform samplerCube u_cubemap;
uniform vec3 camPos;
out vec4 frag_color;
void main() {
    vec3 V = normalize(-v_pos);
    frag_color = vec4(texture(u_cubemap, reflect(-V, normalize(n))).rgb, 1.0);
}
