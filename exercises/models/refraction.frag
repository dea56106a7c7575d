#version 330 core
in vec3 world_position;
in vec3 v_normal;
in vec3 v_from_eye;

uniform vec3 u_view_pos;
uniform float refractionIndice;
uniform samplerCube cubemapSampler;

out vec4 FragColor;

void main() {
    vec3 N = normalize(v_normal);
    vec3 from_eye = world_position - u_view_pos;
    vec3 I = normalize(from_eye);
    float ratio = 1.0 / refractionIndice;
    vec3 R = refract(I, N, ratio);
    vec3 looked_up = R;
    vec3 found = texture(cubemapSampler, looked_up).rgb;
    FragColor = vec4(found, 1.0);
}
