#version 330 core
in vec3 v_frag_coord;
in vec3 v_normal;
in vec2 texCoord_v;
out vec4 FragColor;
struct Light { vec3 light_pos; float ambient_strength; float diffuse_strength; float specular_strength; float constant; float linear; float quadratic; };
uniform Light light;
uniform vec3 view_dir; // camera position in world space (bad name, sorry)
uniform vec3 materialColour;
uniform float shininess;
void main()
{
    vec3 N = normalize(v_normal);
    vec3 toL = light.light_pos - v_frag_coord;
    float distSquared = dot(toL, toL);
    vec3 L = toL * inversesqrt(distSquared);
    vec3 V = normalize(view_dir - v_frag_coord);
    float lit = 1.0 - step(dot(N, L), 0.0);
    vec4 parts;
    parts.x = light.ambient_strength;
    parts.y = max(dot(N, L), 0.0) * light.diffuse_strength;
    parts.z = lit * pow(max(dot(reflect(-L, N), V), 0.0), shininess) * light.specular_strength;
    parts.w = light.constant + light.linear * sqrt(distSquared) + light.quadratic * distSquared;
    FragColor = vec4(materialColour * (parts.x + parts.y / parts.w + parts.z / parts.w), 1.0);
}
