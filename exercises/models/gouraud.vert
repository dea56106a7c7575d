#version 330 core
// The light equation per vertex: the light is interpolated.
in vec3 position;
in vec3 normal;

uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM; // the inverse transpose of M

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

out vec3 v_col;

// A separate function, in which V is the direction to the eye and not the view matrix.
vec3 light_at(vec3 world_position, vec3 N, vec3 model_position) {
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
    return colour;
}

void main() {
    vec4 world_place = M * vec4(position, 1.0);
    vec3 world_position = world_place.xyz;
    vec3 world_normal = mat3(itM) * normal;
    vec3 N = normalize(world_normal);
    v_col = light_at(world_position, N, position);
    gl_Position = P * V * world_place;
}
