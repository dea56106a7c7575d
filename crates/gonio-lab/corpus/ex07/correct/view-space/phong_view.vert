#version 410 core

layout(location = 0) in vec3 position;
layout(location = 2) in vec3 normal;

uniform mat4 M, V, P;

out VS_OUT {
    vec3 pos_in_view;
    vec3 n_in_view;
    vec3 light_in_view;
} vs_out;

struct Light { vec3 light_pos; float ambient_strength, diffuse_strength, specular_strength, constant, linear, quadratic; };
uniform Light light;

void main()
{
    mat4 MV = V * M;
    vec4 p = MV * vec4(position, 1.0);
    vs_out.pos_in_view = p.xyz;
    vs_out.n_in_view = normalize(transpose(inverse(mat3(MV))) * normal);
    vs_out.light_in_view = (V * vec4(light.light_pos, 1.0)).xyz;
    gl_Position = P * p;
}
