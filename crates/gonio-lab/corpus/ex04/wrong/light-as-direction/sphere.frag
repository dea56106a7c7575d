#version 130
in vec3 normal_v;
in vec3 v_pos;
uniform vec3 u_light_pos;
uniform vec3 materialColour;
out vec4 fragColor;
// TODO clean
void main() {
    vec3 n = normalize(normal_v);
    vec3 l = normalize(u_light_pos);
    float diffuse = max(dot(n, l), 0.0);
    fragColor = vec4(materialColour * diffuse, 1.0);
}
