#version 330 core
// Reflection and refraction: the fragment shader samples the cubemap in a direction that depends on the surface.
in vec3 position;
in vec3 normal;

uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM; // the inverse transpose of M

out vec3 world_position;
out vec3 v_normal;

void main() {
    vec4 world_place = M * vec4(position, 1.0);
    world_position = world_place.xyz;
    vec3 world_normal = mat3(itM) * normal;
    v_normal = normalize(world_normal);
    gl_Position = P * V * world_place;
}
