#version 460 core
in vec3 MvertPos;
in vec3 MvertNormal;
uniform mat4 M, V, P, itM;
uniform vec3 WeyePos, materialColour;
uniform float shininess;
struct Light { vec3 light_pos; float ambient_strength, diffuse_strength, specular_strength; };
uniform Light light;
out Gouraud { vec3 diffuse; vec3 specular; } o;
void main()
{
    vec3 Wpos = (M * vec4(MvertPos, 1)).xyz;
    vec3 N = normalize((itM * vec4(MvertNormal, 0)).xyz);
    vec3 L = normalize(light.light_pos - Wpos);
    vec3 E = normalize(WeyePos - Wpos);
    o.diffuse = light.diffuse_strength * max(0, dot(N, L)) * materialColour;
    o.specular = light.specular_strength * pow(max(0, dot(reflect(-L, N), E)), shininess) * materialColour;
    gl_Position = P * V * vec4(Wpos, 1);
}
