#version 410 core

in VS_OUT {
    vec3 pos_in_view;
    vec3 n_in_view;
    vec3 light_in_view;
} fs_in;

struct Light { vec3 light_pos; float ambient_strength, diffuse_strength, specular_strength, constant, linear, quadratic; };
uniform Light light;
uniform vec3 materialColour;
uniform float shininess;

layout(location = 0) out vec4 FragColor;

void main()
{
    vec3 n = normalize(fs_in.n_in_view);
    vec3 to_light = fs_in.light_in_view - fs_in.pos_in_view;
    float d = length(to_light);
    vec3 l = to_light / d;
    vec3 v = normalize(-fs_in.pos_in_view);   // camera at (0,0,0)

    float diff = max(dot(n, l), 0.0);
    float spec = pow(max(dot(reflect(-l, n), v), 0.0), shininess);
    float att = 1.0 / (light.constant + light.linear * d + light.quadratic * d * d);

    vec3 c = materialColour * (light.ambient_strength + att * (light.diffuse_strength * diff + light.specular_strength * spec));
    FragColor = vec4(c, 1.0);
}
