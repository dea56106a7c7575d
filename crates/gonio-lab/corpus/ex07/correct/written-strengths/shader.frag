#version 330 core
in vec3 v_normal;
in vec3 v_frag_coord;
in vec2 v_tex;
uniform vec3 u_light_pos;
uniform vec3 u_view_pos;
uniform vec3 materialColour;
out vec4 FragColor;

const float ambientStrength = 0.1;
const float diffuseStrength = 0.5;
const float specularStrength = 0.8;
const float kc = 1.0, kl = 0.14, kq = 0.07;

void main()
{
    vec3 N = normalize(v_normal);
    vec3 L = normalize(u_light_pos - v_frag_coord);
    vec3 V = normalize(u_view_pos - v_frag_coord);
    vec3 R = reflect(-L, N);
    float d = distance(u_light_pos, v_frag_coord);
    float att = 1.0 / (kc + kl*d + kq*d*d);
    float ambient = ambientStrength;
    float diffuse = diffuseStrength * max(0.0, dot(N, L));
    float specular = specularStrength * pow(max(0.0, dot(R, V)), 32);
    FragColor = vec4((ambient + att * (diffuse + specular)) * materialColour, 1.0);
}
