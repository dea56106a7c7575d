#version 330 core
in vec3 v_frag_coord;
in vec3 v_normal;
in vec2 v_tex;
out vec4 FragColor;
struct Light { vec3 light_pos; float ambient_strength; float diffuse_strength; float specular_strength; float radius; };
uniform Light light;
uniform vec3 u_view_pos;
uniform float shininess;

void main() {
    vec3 N = normalize(v_normal);
    vec3 L = normalize(light.light_pos - v_frag_coord);
    vec3 V = normalize(u_view_pos - v_frag_coord);
    float d = length(light.light_pos - v_frag_coord);
    float diffuse = light.diffuse_strength * max(dot(N, L), 0.0);
    float specular = light.specular_strength * pow(max(dot(reflect(-L, N), V), 0.0), shininess);
    float fade = clamp(1.0 - d / (3.0 + light.radius), 0.0, 1.0);
    FragColor = vec4(vec3(light.ambient_strength + fade * (diffuse + specular)), 1.0);
}
