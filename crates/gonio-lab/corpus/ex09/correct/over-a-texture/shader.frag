#version 330 core
in vec3 FragPos;
in vec3 Normal;
in vec2 TexCoords;
out vec4 FragColor;
uniform vec3 viewPos;
uniform samplerCube skybox;
uniform sampler2D paint;
uniform float mirror;

void main()
{
    vec3 seen = reflect(normalize(FragPos - viewPos), normalize(Normal));
    vec3 chrome = texture(skybox, seen).rgb * vec3(1.0, 0.8, 0.4);
    if (texture(paint, TexCoords).a < 0.01) discard;
    FragColor = vec4(mix(texture(paint, TexCoords).rgb, chrome, clamp(mirror, 0.0, 1.0)), 1.0);
}
