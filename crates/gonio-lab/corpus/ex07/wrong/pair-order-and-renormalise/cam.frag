#version 330 core
in vec3 pos;
in vec3 nor;
flat in vec3 eye;
out vec4 color_out;
struct Light { vec3 light_pos; float ambient_strength; float diffuse_strength; float specular_strength; float constant; float linear; float quadratic; };
uniform Light light;
uniform vec3 materialColour;
uniform float shininess;
// ------------
void main()
{
    vec3 n = nor;
    vec3 fromLight = normalize(pos - light.light_pos);   // incident
    vec3 mirrored = reflect(fromLight, n);
    float d = distance(pos, light.light_pos);
    float a = 1.0 / (light.constant + light.linear * d + light.quadratic * d * d);
    float dif = max(dot(n, -fromLight), 0.0);
    float spe = pow(max(dot(mirrored, normalize(eye - pos)), 0.0), shininess);
    color_out.rgb = materialColour * (light.ambient_strength + a * (light.diffuse_strength * dif + light.specular_strength * spe));
    color_out.a = 1.0;
}
