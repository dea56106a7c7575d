#version 330 core
in vec3 v_frag_coord;
in vec3 v_normal;
out vec4 FragColor;
uniform vec3 u_light_pos;
uniform vec3 u_view_pos;
uniform vec3 materialColour;
void main(){
vec3 n = normalize(v_normal);
vec3 l = normalize(u_light_pos - v_frag_coord);
vec3 v = normalize(v_frag_coord - u_view_pos); // incoming
vec3 r = reflect(l, n);
float diff = max(dot(n, l), 0.0f);
float spec = pow(max(dot(v, r), 0.0f), 32.0f);
FragColor = vec4(vec3(diff + spec) * materialColour, 1.0f);
}
