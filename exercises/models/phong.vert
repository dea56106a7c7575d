#version 330 core
// The light equation per fragment, with everything that any exercise asks for. Every line that the catalogue of mistakes
// changes is a statement of its own, `name = value;`.
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
uniform vec3 u_view_pos;

out vec3 world_position;
out vec3 v_normal;
out vec3 model_position; // for mistakes in which M is missing
// For mistakes in which directions are interpolated.
out vec3 v_to_light;
out vec3 v_to_eye;

void main() {
    vec4 world_place = M * vec4(position, 1.0);
    world_position = world_place.xyz;
    model_position = position;
    vec3 world_normal = mat3(itM) * normal;
    v_normal = normalize(world_normal);
    v_to_light = light.light_pos - world_position;
    v_to_eye = u_view_pos - world_position;
    gl_Position = P * V * world_place;
}
