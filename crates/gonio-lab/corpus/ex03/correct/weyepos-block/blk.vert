#version 460 core
in vec3 MvertPos;
in vec3 MvertNormal;
uniform mat4 M, V, P, itM;
struct Light { vec3 light_pos; float ambient_strength; float diffuse_strength; float specular_strength; };
uniform Light light;
uniform vec3 materialColour;
out Lit { vec3 colour; } lit;
void main()
{
    vec4 Wpos = M * vec4(MvertPos, 1.0);
    vec3 Wnormal = normalize(mat3(itM) * MvertNormal);
    vec3 Wlight = normalize(light.light_pos - Wpos.xyz);
    lit.colour = light.diffuse_strength * max(dot(Wnormal, Wlight), 0.0) * materialColour;
    gl_Position = P * V * Wpos;
}
