#version 330 core
in vec3 WvertPos;
in vec3 WvertNormal;
uniform vec3 WeyePos;
uniform samplerCube cubemapSampler;
out vec4 FragColor;
vec3 sky(vec3 direction) { return texture(cubemapSampler, direction).rgb; }
void main() {
    vec3 towardsEye = normalize(WeyePos - WvertPos);
    FragColor = vec4(sky(reflect(-towardsEye, normalize(WvertNormal))), 1.0);
}
