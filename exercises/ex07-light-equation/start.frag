#version 330 core
// Exercise 07: the light equation. So far, the ambient term alone: a flat, dark disc.

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
uniform float shininess; // the exponent
uniform vec3 materialColour;

out vec4 FragColor;

void main() {
    float ambient = light.ambient_strength;
    // TODO: the diffuse term, with its strength.
    // TODO: the specular term, with its strength.
    // TODO: the attenuation. Of which distance? And which of the three terms does it weaken?
    float sum = ambient;
    FragColor = vec4(materialColour * sum, 1.0);
}
