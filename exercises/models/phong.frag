#version 330 core
in vec3 world_position;
in vec3 v_normal;
in vec3 model_position;
in vec3 v_to_light;
in vec3 v_to_eye;

struct Light {
    vec3 light_pos;
    float ambient_strength;
    float diffuse_strength;
    float specular_strength;
    float constant;
    float linear;
    float quadratic;
};
uniform Light light;
uniform float shininess;
uniform float written_exponent; // a number that is written instead of the shininess
uniform vec3 materialColour;
uniform vec3 u_view_pos;
uniform vec3 other_light_pos; // of a light other than the one that is computed here

out vec4 FragColor;

void main() {
    vec3 N = normalize(v_normal);
    vec3 to_light = light.light_pos - world_position;
    vec3 L = normalize(to_light);
    vec3 to_eye = u_view_pos - world_position;
    vec3 V = normalize(to_eye);
    vec3 R = reflect(-L, N);
    float cos_theta = max(dot(N, L), 0.0);
    float cos_highlight = dot(R, V);
    float cos_phi = max(cos_highlight, 0.0);
    float spec = pow(cos_phi, shininess);
    float d = length(to_light);
    float attenuation = 1.0 / (light.constant + light.linear * d + light.quadratic * d * d);
    float diffuse = light.diffuse_strength * cos_theta;
    float specular = light.specular_strength * spec;
    float ambient = light.ambient_strength;
    float diffuse_light = attenuation * diffuse;
    float specular_light = attenuation * specular;
    float attenuated = diffuse_light + specular_light;
    float lit = ambient + attenuated;
    vec3 colour = materialColour * lit;
    FragColor = vec4(colour, 1.0);
}
