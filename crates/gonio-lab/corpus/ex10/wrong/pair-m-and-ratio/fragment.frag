#version 400 core
out vec4 frag_color;
precision mediump float;
in vec3 fragCoord;
in vec3 n;
uniform vec3 camPos;
uniform samplerCube cubemapSampler;
uniform float refractionIndice;


void main() {
    float ratio = refractionIndice;
    vec3 N = normalize(n);
    vec3 V = normalize(camPos - fragCoord);
    vec3 R = refract(-V, N, ratio);
    frag_color = texture(cubemapSampler, R);
}
