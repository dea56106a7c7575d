#version 150
in vec3 pos;
in vec3 n;
uniform vec3 u_light_pos;
uniform vec3 u_view_pos;
uniform float shininess;
out vec4 color_out;
// ------------
void main()
{
    vec3 nn = normalize(n);
    vec3 light = normalize(u_light_pos);
    vec3 eye = normalize(u_view_pos - pos);
    vec3 refl = reflect(-light, nn);
    float I = max(dot(nn, light), 0.0) + pow(max(dot(refl, eye), 0.0), shininess);
    color_out = vec4(I, I, I, 1.0);
}
