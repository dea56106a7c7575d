#version 150
in vec3 vNormal;
in vec3 v_pos;
uniform vec3 u_light_pos;
uniform vec3 materialColour;
out vec4 color_out;

void main() {
    vec3 n = normalize(vNormal);
    vec3 l = normalize(u_light_pos - v_pos);
    float diffuse = dot(n, l);
    color_out = vec4(materialColour * diffuse, 1.0);
}
