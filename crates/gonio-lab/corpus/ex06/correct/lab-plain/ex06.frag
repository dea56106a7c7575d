#version 400 core
out vec4 FragColor;
precision mediump float;
in vec3 v_frag_coord;
in vec3 v_normal;
uniform vec3 u_light_pos;
uniform vec3 u_view_pos;
uniform vec3 materialColour;
void main() {
    vec3 N = normalize(v_normal);
    vec3 L = normalize(u_light_pos - v_frag_coord);
    vec3 V = normalize(u_view_pos - v_frag_coord);
    vec3 R = reflect(-L, N);
    float diffuse = max(dot(N, L), 0.0);
    float cosTheta = dot(R, V);
    float specular = pow(max(cosTheta, 0.0), 32.0);
    FragColor = vec4(materialColour * (diffuse + specular), 1.0);
}
