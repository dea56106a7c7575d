#version 330 core
// Rim light: diffuse light, and a bright rim where the surface turns away from the camera.

in vec3 v_place;  // in the world
in vec3 v_normal; // in the world

uniform vec3 light_pos;  // in the world
uniform vec3 u_view_pos; // the camera's position in the world
uniform vec3 materialColour;
uniform float diffuse_strength;
uniform float rim_strength;
uniform float rim_exponent;

out vec4 FragColor;

void main() {
    vec3 N = normalize(v_normal);
    vec3 L = normalize(light_pos - v_place);
    vec3 V = normalize(u_view_pos - v_place);

    float diffuse = diffuse_strength * max(dot(N, L), 0.0);
    float facing = max(dot(N, V), 0.0);
    float rim = rim_strength * pow(1.0 - facing, rim_exponent);

    FragColor = vec4(materialColour * diffuse + vec3(rim), 1.0);
}
