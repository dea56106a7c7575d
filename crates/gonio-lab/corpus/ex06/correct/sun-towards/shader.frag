#version 330 core
in vec3 v_frag_coord;
in vec3 v_normal;
out vec4 FragColor;
struct Sun { vec3 direction; vec3 color; float ambient_strength; float diffuse_strength; float specular_strength; };
uniform Sun light;
uniform vec3 u_view_pos;
uniform float shininess;
struct Fog { vec3 color; float density; };
uniform Fog fog;

void main() {
    vec3 N = normalize(v_normal);
    vec3 L = normalize(light.direction);
    vec3 V = normalize(u_view_pos - v_frag_coord);
    float specular = light.specular_strength * pow(max(dot(reflect(-L, N), V), 0.0), shininess);
    float lit = light.ambient_strength + light.diffuse_strength * max(dot(N, L), 0.0) + specular;
    float clear = clamp(exp(-fog.density * length(u_view_pos - v_frag_coord)), 0.0, 1.0);
    FragColor = vec4(mix(fog.color, light.color * lit, clear), 1.0);
}
