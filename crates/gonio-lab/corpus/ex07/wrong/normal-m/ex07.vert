#version 330
in vec3 position;
in vec2 tex_coords;
in vec3 normal;

out vec3 v_world;
out vec3 v_n;

uniform mat4 M;
uniform mat4 V;
uniform mat4 P;

// ------------
void main()
{
    vec4 frag_coord = M * vec4(position, 1.0);
    gl_Position = P * V * frag_coord;
    v_n = normalize(vec3(M * vec4(normal, 0.0)));
    v_world = frag_coord.xyz;
}
