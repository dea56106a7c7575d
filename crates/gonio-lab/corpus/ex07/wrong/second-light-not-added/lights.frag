#version 330 core
in vec3 v_frag_coord;
in vec3 v_normal;
struct Light {
    vec3 light_pos;
    float ambient_strength;
    float diffuse_strength;
    float specular_strength;
    float constant;
    float linear;
    float quadratic;
};
uniform vec3 u_view_pos;
uniform vec3 materialColour;
uniform float shininess;
out vec4 FragColor;
#define MAX_LIGHTS 4
uniform Light lights[MAX_LIGHTS];
uniform int nLights;
vec3 one(Light l, vec3 N, vec3 V) {
    vec3 L = normalize(l.light_pos - v_frag_coord);
    float d = distance(l.light_pos, v_frag_coord);
    float att = 1.0 / (l.constant + d * (l.linear + d * l.quadratic));
    float diffuse = l.diffuse_strength * max(dot(N, L), 0.0);
    float specular = l.specular_strength * pow(max(dot(V, reflect(-L, N)), 0.0), shininess);
    return materialColour * (l.ambient_strength + att * (diffuse + specular));
}
void main() {
    vec3 N = normalize(v_normal);
    vec3 V = normalize(u_view_pos - v_frag_coord);
    vec3 colour = vec3(0.0);
    for (int i = 0; i < nLights - 1 || i < 1; i++) colour += one(lights[i], N, V);
    FragColor = vec4(colour, 1.0);
}
