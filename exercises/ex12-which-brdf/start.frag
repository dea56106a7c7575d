#version 330 core
// Exercise 12: which BRDF? So far, the ambient term alone: a flat, dark disc.

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

// The BRDF of the surface, in 1/sr. All directions point away from the surface, and have length 1.
float brdf(vec3 N, vec3 L, vec3 V) {
    float diffuse = light.diffuse_strength / PI;
    // TODO: Ward's BRDF, with its strength. What is it where one of the cosines is not positive?
    return diffuse;
}

void main() {
    float sum = light.ambient_strength;
    // TODO: the directions and the attenuation of exercise 07.
    // TODO: the light that the surface receives from the lamp, and the share of it that leaves towards the eye.
    FragColor = vec4(materialColour * sum, 1.0);
}
