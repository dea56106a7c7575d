#version 440 core
in vec3 vNormal;
in vec3 vPos;
in vec2 v_tex;
uniform vec3 u_light_pos;
uniform vec3 u_view_pos;
uniform vec3 materialColour;
out vec4 color_out;

const float ambientStrength = 0.1;
const float diffuseStrength = 0.5;
const float specularStrength = 0.8;
const float kc = 1.0, kl = 0.14, kq = 0.07;



void main()
{
    vec3 N = normalize(vNormal);
    vec3 L = normalize(u_light_pos - vPos);
    vec3 V = normalize(u_view_pos - vPos);
    vec3 R = reflect(-L, N);
    float d = distance(u_light_pos, vPos);
    float att = 1.0 / (kc + kl*d + kq*d*d);
    float ambient = ambientStrength;
    float diffuse = diffuseStrength * max(0.0, dot(N, L));
    float specular = specularStrength * pow(max(0.0, dot(R, V)), 32);
    color_out = vec4((ambient + att * (diffuse + specular)) * materialColour, 1.0);
}
