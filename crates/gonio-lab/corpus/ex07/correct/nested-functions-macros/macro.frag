#version 330 core
#define SATURATE(x) clamp((x), 0.0, 1.0)
#define SQR(x) ((x) * (x))
in vec3 v_frag_coord;
in vec3 v_normal;
out vec4 FragColor;
struct Light { vec3 light_pos; float ambient_strength; float diffuse_strength; float specular_strength; float constant; float linear; float quadratic; };
uniform Light light;
uniform vec3 u_view_pos;
uniform vec3 materialColour;
uniform float shininess;
void main()
{
    vec3 N = normalize(v_normal);
    vec3 L = normalize(light.light_pos - v_frag_coord);
    vec3 V = normalize(u_view_pos - v_frag_coord);
    float d = length(light.light_pos - v_frag_coord);
    float att = 1.0 / (light.constant + light.linear * d + light.quadratic * SQR(d));
    float nl = dot(N, L);
    float spec = 0.0;
    if (nl > 0.0)
    {
        spec = pow(SATURATE(dot(reflect(-L, N), V)), shininess);
    }
    vec3 ambient = light.ambient_strength * vec3(1.0);
    vec3 diffuse = light.diffuse_strength * SATURATE(nl) * vec3(1.0);
    vec3 specular = light.specular_strength * spec * vec3(1.0);
    FragColor = vec4(materialColour * (ambient + (diffuse + specular) * att), 1.0);
}
