#version 330 core
// Reflection and refraction: the fragment shader samples the cubemap in a direction that depends on the surface.
in vec3 position;
in vec3 normal;

uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM; // the inverse transpose of M
uniform vec3 u_view_pos;
uniform float refractionIndice;

out vec3 world_position;
out vec3 v_normal;
// For mistakes in which directions are interpolated.
out vec3 v_from_eye;

void main() {
    vec4 world_place = M * vec4(position, 1.0);
    world_position = world_place.xyz;
    vec3 world_normal = mat3(itM) * normal;
    v_normal = normalize(world_normal);
    v_from_eye = world_position - u_view_pos;
    gl_Position = P * V * world_place;
}
