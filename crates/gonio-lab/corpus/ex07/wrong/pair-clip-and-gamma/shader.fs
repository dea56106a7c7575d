#version 330 core
precision highp float;
in vec3 FragPos;
in vec3 Normal;
layout(location = 0) out vec4 FragColor;
struct Light { vec3 light_pos; float ambient_strength, diffuse_strength, specular_strength; float constant, linear, quadratic; };
uniform Light light;
uniform vec3 viewPos;
uniform vec3 materialColour;
uniform float shininess;

vec3 N, L, V, R;     // global, set in main
float D;

float ambient()  { return light.ambient_strength; }
float diffuse()  { return light.diffuse_strength * max(dot(N, L), 0); }
float specular() { return light.specular_strength * pow(max(dot(R, V), 0), shininess); }
float att()      { return 1 / (light.constant + light.linear*D + light.quadratic*D*D); }

void main() {
    N = normalize(Normal);
    L = light.light_pos - FragPos;
    D = length(L);
    L = normalize(L);
    V = normalize(viewPos - FragPos);
    R = reflect(-L, N);
    vec3 c = (ambient() + att()*(diffuse() + specular()))*materialColour;
    FragColor = vec4(pow(c, vec3(1/2.2)), 1);
}
