#version 410 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
uniform mat4 M, V, P;
uniform vec3 u_light_pos, materialColour;
out vec3 colour;
void main() {
    mat4 MV = V * M;
    vec3 p = (MV * vec4(position, 1.0)).xyz;
    vec3 n = normalize(transpose(inverse(mat3(MV))) * normal);
    vec3 l = normalize((V * vec4(u_light_pos, 1.0)).xyz - p);
    colour = materialColour * max(dot(n, l), 0.0);
    gl_Position = P * vec4(p, 1.0);
}
