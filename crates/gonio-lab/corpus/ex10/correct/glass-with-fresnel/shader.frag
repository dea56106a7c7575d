#version 330 core
in vec3 v_frag_coord;
in vec3 v_normal;
out vec4 FragColor;
uniform vec3 u_view_pos;
uniform samplerCube cubemapSampler;
uniform float refractionIndice;

void main() {
    vec3 N = normalize(v_normal);
    vec3 V = normalize(u_view_pos - v_frag_coord);
    vec4 through = texture(cubemapSampler, refract(-V, N, 1.0 / refractionIndice));
    vec4 back = texture(cubemapSampler, reflect(-V, N));
    float share = pow(1.0 - max(dot(N, V), 0.0), 3.0);
    FragColor = mix(through, back, share);
}
