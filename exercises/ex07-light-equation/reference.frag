#version 330 core
// Exercise 07: the light equation

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
    vec3 N = normalize(v_normal);
    vec3 L = normalize(light.light_pos - v_frag_coord);
    vec3 V = normalize(u_view_pos - v_frag_coord);
    vec3 R = reflect(-L, N);

    float ambient = light.ambient_strength;
    float diffuse = light.diffuse_strength * max(dot(N, L), 0.0);
    float specular = light.specular_strength * pow(max(dot(R, V), 0.0), shininess);

    float d = length(light.light_pos - v_frag_coord);
    float attenuation = 1.0 / (light.constant + light.linear * d + light.quadratic * d * d);

    // Ambient light represents light from everywhere: it does not fade with distance.
    float sum = ambient + attenuation * (diffuse + specular);
    FragColor = vec4(materialColour * sum, 1.0);
}
