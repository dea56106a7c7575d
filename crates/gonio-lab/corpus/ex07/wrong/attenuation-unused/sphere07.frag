#version 460 core
out vec4 outColor;
in vec3 v_frag_coord;
in vec3 v_normal;
in vec4 v_col;
in vec2 v_t;

uniform sampler2D ourTexture;
uniform float now;
uniform vec3 u_view_pos;
uniform vec3 u_light_pos; // old one, before the struct

struct Light {
    vec3 light_pos;
    float ambient_strength;
    float diffuse_strength;
    float specular_strength;
    float constant;
    float linear;
    float quadratic;
};
uniform Light light;
uniform float shininess;
uniform vec3 materialColour;

/*
float oldSpecular() {
    return pow(dot(reflect(L, N), V), 16.0);
}
*/

// ------------
void main(){
    vec3 N = normalize(v_normal);
    vec3 lightVector = light.light_pos - v_frag_coord;
    vec3 L = normalize(lightVector);
    vec3 V = normalize(u_view_pos - v_frag_coord);
    vec3 R = reflect(-L, N);

    float ambient = light.ambient_strength;
    float diffuse = light.diffuse_strength * max(dot(N, L), 0.0);
    float specular = light.specular_strength * pow(max(dot(R, V), 0.0), shininess);
    float d = length(lightVector);
    float att = 1.0 / (light.constant + light.linear * d + light.quadratic * d * d);

    // vec3 tex = texture(ourTexture, v_t).rgb;
    vec3 colour = materialColour * (ambient + diffuse + specular);
    // outColor = vec4(N, 1.0);
    // outColor = v_col;
    outColor = vec4(colour, 1.0);
}
