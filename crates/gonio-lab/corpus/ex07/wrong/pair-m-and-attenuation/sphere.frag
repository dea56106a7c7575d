#version 150
out vec4 frag_color;
precision mediump float;

in vec3 fragCoord;
in vec3 n;

uniform vec3 camPos;

struct Light {
    vec3 light_pos;
    float ambient_strength;
    float diffuse_strength;
    float specular_strength;
    // attenuation factors
    float constant;
    float linear;
    float quadratic;
};
uniform Light light;
uniform float shininess;
uniform vec3 materialColour;

float specularCalculation(vec3 N, vec3 L, vec3 V) {
    vec3 R = reflect(-L, N);
    float cosTheta = dot(R, V);
    float spec = pow(max(cosTheta, 0.0), 32.0);
    return light.specular_strength * spec;
}

// TODO clean
void main() {
    vec3 N = normalize(n);
    vec3 L = normalize(light.light_pos - fragCoord);
    vec3 V = normalize(camPos - fragCoord);
    float specular = specularCalculation(N, L, V);
    float diffuse = light.diffuse_strength * max(dot(N, L), 0.0);
    float distance = length(light.light_pos - fragCoord);
    float attenuation = 1.0 / (light.constant + light.linear * distance + light.quadratic * distance * distance);
    float total = light.ambient_strength + (diffuse + specular);
    frag_color = vec4(materialColour * vec3(total), 1.0);
}
