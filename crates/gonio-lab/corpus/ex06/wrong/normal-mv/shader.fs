#version 460 core
in vec3 vPos;
in vec3 vNormal;
uniform vec3 u_light_pos;
uniform vec3 u_view_pos;
uniform vec3 materialColour;
uniform float shininess;
out vec4 color_out;

void main() {
    vec3 N = normalize(vNormal);
    vec3 L = normalize(u_light_pos - vPos);
    vec3 V = normalize(u_view_pos - vPos);
    vec3 R = reflect(-L, N);


    float diffuse = max(dot(N, L), 0.0);
    float specular = pow(max(dot(R, V), 0.0), shininess);

    color_out = vec4(materialColour * (diffuse + specular), 1.0);
}
