#version 330 core
// Ward's BRDF per vertex: the light is interpolated.
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
uniform float roughness; // Ward's alpha
uniform vec3 materialColour;
uniform vec3 u_view_pos;
uniform vec3 other_light_pos; // of a light other than the one that is computed here

out vec3 v_col;

// A separate function, in which V is the direction to the eye and not the view matrix.
vec3 light_at(vec3 world_position, vec3 N, vec3 model_position) {
    float PI = 3.14159265;
    vec3 to_light = light.light_pos - world_position;
    vec3 L = normalize(to_light);
    vec3 to_eye = u_view_pos - world_position;
    vec3 V = normalize(to_eye);
    vec3 H = normalize(L + V);
    float cos_theta = max(dot(N, L), 0.0);
    float cos_view = max(dot(N, V), 0.0001);
    float cut = min(dot(N, L), dot(N, V)) > 0.0 ? 1.0 : 0.0;
    float cos_delta = dot(N, H);
    float tan_squared = 1.0 / (cos_delta * cos_delta) - 1.0;
    float gauss = exp(-tan_squared / (roughness * roughness));
    float root = sqrt(max(dot(N, L), 0.0001) * cos_view);
    float ward = cut * gauss / (4.0 * PI * roughness * roughness * root);
    float d = length(to_light);
    float attenuation = 1.0 / (light.constant + light.linear * d + light.quadratic * d * d);
    float diffuse = light.diffuse_strength * cos_theta;
    float specular = light.specular_strength * PI * ward * cos_theta;
    float ambient = light.ambient_strength;
    float diffuse_light = attenuation * diffuse;
    float specular_light = attenuation * specular;
    float attenuated = diffuse_light + specular_light;
    float lit = ambient + attenuated;
    vec3 colour = materialColour * lit;
    // What programs compute on the way, and nothing here reads.
    float delta = acos(min(cos_delta, 1.0));
    float tangent = sqrt(max(tan_squared, 0.0));
    float alpha_squared = roughness * roughness;
    float exponent = -tan_squared / alpha_squared;
    float normalisation = 4.0 * PI * alpha_squared;
    float divisor = normalisation * root;
    float diffuse_brdf = light.diffuse_strength / PI;
    float specular_brdf = light.specular_strength * ward;
    float brdf = diffuse_brdf + specular_brdf;
    float irradiance = attenuation * PI * cos_theta;
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
