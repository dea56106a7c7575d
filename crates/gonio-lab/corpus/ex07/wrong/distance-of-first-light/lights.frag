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
uniform Light light1;
uniform Light light2;
void main() {
    vec3 N = normalize(v_normal);
    vec3 V = normalize(u_view_pos - v_frag_coord);

    vec3 to1 = light1.light_pos - v_frag_coord;
    vec3 L1 = normalize(to1);
    float d1 = length(to1);
    float a1 = 1.0 / (light1.constant + light1.linear * d1 + light1.quadratic * d1 * d1);
    float first = light1.diffuse_strength * max(dot(N, L1), 0.0)
                + light1.specular_strength * pow(max(dot(reflect(-L1, N), V), 0.0), shininess);

    vec3 to2 = light2.light_pos - v_frag_coord;
    vec3 L2 = normalize(to2);
    float d2 = length(to1);
    float a2 = 1.0 / (light2.constant + light2.linear * d2 + light2.quadratic * d2 * d2);
    float second = light2.diffuse_strength * max(dot(N, L2), 0.0)
                 + light2.specular_strength * pow(max(dot(reflect(-L2, N), V), 0.0), shininess);

    float ambient = light1.ambient_strength + light2.ambient_strength;
    FragColor = vec4(materialColour * (ambient + a1 * first + a2 * second), 1.0);
}
