#version 300 es
precision highp float;
precision highp samplerCube;
in vec3 Normal;
in vec3 v_pos;
uniform samplerCube u_cubemap;
uniform vec3 viewPos;
out vec4 FragColor;
// ------------
void main() {
    vec3 V = normalize(viewPos - v_pos);
    FragColor = vec4(texture(u_cubemap, reflect(-V, Normal)).rgb, 1.0);
}
