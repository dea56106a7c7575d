#version 130
in vec3 position;
in vec2 tex_coord;
in vec3 normal;

out vec3 fragCoord;
out vec3 n;

uniform mat4 M;
uniform mat4 itM;
uniform mat4 V;
uniform mat4 P;

// TODO clean
void main() {
    vec4 frag_coord = M * vec4(position, 1.0);
    gl_Position = P * V * frag_coord;
    n = normalize(vec3(V * M * vec4(normal, 0.0)));
    fragCoord = frag_coord.xyz;
}
