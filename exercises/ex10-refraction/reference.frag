#version 330 core
// Exercise 10: refraction

in vec3 v_frag_coord; // in the world
in vec3 v_normal;     // in the world

uniform samplerCube cubemapSampler;
uniform vec3 u_view_pos;        // the camera's position in the world
uniform float refractionIndice; // of the object: glass 1.52

out vec4 FragColor;

void main() {
    vec3 N = normalize(v_normal);
    vec3 V = normalize(u_view_pos - v_frag_coord);
    // From air into the object. Light that enters a denser medium is never totally reflected.
    vec3 T = refract(-V, N, 1.0 / refractionIndice);
    FragColor = vec4(texture(cubemapSampler, T).rgb, 1.0);
}
