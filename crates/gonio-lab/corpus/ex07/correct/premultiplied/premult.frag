#version 330 core
precision highp float;
in vec3 v_frag_coord;
in vec3 v_normal;
layout(location = 0) out vec4 FragColor;
struct Light { vec3 light_pos; float ambient_strength, diffuse_strength, specular_strength; float constant, linear, quadratic; };
uniform Light light;
uniform vec3 u_view_pos;
uniform vec3 materialColour;
uniform float shininess;

vec3 N, L, V, R;     // global, set in main
float D;

float ambient()  { return light.ambient_strength; }
float diffuse()  { return light.diffuse_strength * max(dot(N, L), 0); }
float specular() { return light.specular_strength * pow(max(dot(R, V), 0), shininess); }
float att()      { return 1 / (light.constant + light.linear*D + light.quadratic*D*D); }

void main() {
    N = normalize(v_normal);
    L = light.light_pos - v_frag_coord;
    D = length(L);
    L = normalize(L);
    V = normalize(u_view_pos - v_frag_coord);
    R = reflect(-L, N);
    FragColor = vec4((ambient() + att()*(diffuse() + specular()))*materialColour, 1);
}
