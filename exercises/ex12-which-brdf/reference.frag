#version 330 core
// Exercise 12: which BRDF? Ward's.

in vec3 v_frag_coord; // in the world
in vec3 v_normal;     // in the world

struct Light {
    vec3 light_pos; // in the world
    float ambient_strength;
    float diffuse_strength;
    float specular_strength;
    // Attenuation: k_c, k_l and k_q.
    float constant;
    float linear;
    float quadratic;
};

uniform Light light;
uniform vec3 u_view_pos; // the camera's position in the world
uniform float roughness; // Ward's alpha: an RMS slope
uniform vec3 materialColour;

out vec4 FragColor;

const float PI = 3.14159265;
const float LAMP = PI; // the lamp's light: a white, matte surface that faces it has a brightness of 1

// Ward's BRDF for a strength of 1, in 1/sr. All directions point away from the surface.
float ward(vec3 N, vec3 L, vec3 V) {
    float cos_light = dot(N, L);
    float cos_eye = dot(N, V);
    if (cos_light <= 0.0 || cos_eye <= 0.0) {
        return 0.0;
    }
    vec3 H = normalize(L + V);
    float cos_delta = dot(N, H);
    float tan_squared = 1.0 / (cos_delta * cos_delta) - 1.0;
    float alpha_squared = roughness * roughness;
    return exp(-tan_squared / alpha_squared) / (4.0 * PI * alpha_squared * sqrt(cos_light * cos_eye));
}

// The BRDF of the surface, in 1/sr.
float brdf(vec3 N, vec3 L, vec3 V) {
    float diffuse = light.diffuse_strength / PI;
    return diffuse + light.specular_strength * ward(N, L, V);
}

void main() {
    vec3 N = normalize(v_normal);
    vec3 L = normalize(light.light_pos - v_frag_coord);
    vec3 V = normalize(u_view_pos - v_frag_coord);

    float d = length(light.light_pos - v_frag_coord);
    float attenuation = 1.0 / (light.constant + light.linear * d + light.quadratic * d * d);

    // The light that arrives, spread over the surface, times the share that leaves towards the eye.
    float received = LAMP * attenuation * max(dot(N, L), 0.0);
    float sum = light.ambient_strength + brdf(N, L, V) * received;
    FragColor = vec4(materialColour * sum, 1.0);
}
