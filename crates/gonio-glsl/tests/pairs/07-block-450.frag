#version 450 core
layout(location = 0) out vec4 FragColor;
in VS_OUT {
    vec3 FragPos;
    vec3 Normal;
    flat int id;
    vec2 TexCoords;
} fs_in;
layout(binding = 3) uniform sampler2D diffuseTexture;
struct Light { vec3 position; vec3 color; };
const int COUNT = 2;
uniform Light lights[COUNT];
void main()
{
    vec3 color = texture(diffuseTexture, fs_in.TexCoords).rgb;
    vec3 sum = vec3(0);
    float k[3] = {1, 0.5, 0.25};
    for (int i = 0; i < COUNT; i++) {
        vec3 L = normalize(lights[i].position - fs_in.FragPos);
        sum += k[i] * max(dot(L, normalize(fs_in.Normal)), 0) * lights[i].color / 1;
    }
    const float gain = sum.x > 1 ? 0.5 : fma(sum.x, 2, 1);
    FragColor = vec4(color * sum * gain * (fs_in.id + 1), 1);
}
