#version 330
in vec3 WvertPos;
in vec3 WvertNormal;
uniform vec3 WeyePos;
uniform samplerCube cubemapSampler;
out vec4 FragColor;
const float airIndex = 1.0;
const float glassIndex = 1.52;
vec3 sky(vec3 direction) { return texture(cubemapSampler, vec3(direction.x, -direction.y, direction.z)).rgb; }
void main() {
    vec3 towardsEye = normalize(WeyePos - WvertPos);
    FragColor = vec4(sky(refract(-towardsEye, normalize(WvertNormal), airIndex / glassIndex)), 1.0);
}
