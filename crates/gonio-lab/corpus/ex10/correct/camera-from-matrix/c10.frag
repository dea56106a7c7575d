#version 330 core
in vec3 p, n;
uniform mat4 V;
uniform float refractionIndice;
uniform samplerCube cubemapSampler;
out vec4 o;
void main() { o = texture(cubemapSampler, refract(normalize(p - inverse(V)[3].xyz), normalize(n), 1/refractionIndice)); }
