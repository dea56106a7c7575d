#version 330 core
in vec3 position;
in vec2 tex_coord;
in vec3 normal;

uniform mat4 M;
uniform mat4 itM;
uniform mat4 V;
uniform mat4 P;
uniform vec3 u_view_pos;

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
uniform vec3 materialColour;

out vec3 v_col;

void main() {
    vec4 world = M * vec4(position, 1.0);
    gl_Position = P * V * world;
    vec3 N = normalize(vec3(itM * vec4(normal, 0.0)));
    vec3 L = normalize(light.light_pos - world.xyz);
    vec3 E = normalize(u_view_pos - world.xyz);
    float d = length(light.light_pos - world.xyz);
    float att = 1.0 / (light.constant + light.linear * d + light.quadratic * d * d);
    float diff = light.diffuse_strength * max(dot(N, L), 0.0);
    float spec = light.specular_strength * pow(max(dot(reflect(-L, N), E), 0.0), shininess);
    v_col = materialColour * (light.ambient_strength + att * (diff + spec));
}
