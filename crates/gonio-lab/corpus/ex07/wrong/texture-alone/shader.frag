#version 330 core
in vec3 v_frag_coord;
in vec3 v_normal;
in vec2 v_tex;
out vec4 FragColor;
struct Light { vec3 light_pos; float ambient_strength; float diffuse_strength; float specular_strength; float constant; float linear; float quadratic; };
uniform Light light;
uniform vec3 u_view_pos;
uniform float shininess;
uniform sampler2D ourTexture;

void main() {
    vec3 N = normalize(v_normal);
    vec3 L = normalize(light.light_pos - v_frag_coord);
    vec3 V = normalize(u_view_pos - v_frag_coord);
    float d = length(light.light_pos - v_frag_coord);
    float diffuse = light.diffuse_strength * max(dot(N, L), 0.0);
    float specular = light.specular_strength * pow(max(dot(reflect(-L, N), V), 0.0), shininess);
    float attenuation = 1.0 / (light.constant + light.linear * d + light.quadratic * d * d);
    float lit = light.ambient_strength + attenuation * (diffuse + specular);
    FragColor = texture(ourTexture, v_tex);
}
