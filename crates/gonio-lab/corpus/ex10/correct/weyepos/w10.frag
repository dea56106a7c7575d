#version 330 core
in vec3 WvertPos;
in vec3 WvertNormal;
uniform vec3 WeyePos;
uniform samplerCube cubemapSampler;
out vec4 FragColor;
const float airIndex = 1.0;
const float glassIndex = 1.52;
vec3 sky(vec3 direction) { return texture(cubemapSampler, direction).rgb; }
void main() {
    vec3 towardsEye = normalize(WeyePos - WvertPos);
    FragColor = vec4(sky(refract(-towardsEye, normalize(WvertNormal), airIndex / glassIndex)), 1.0);
}
