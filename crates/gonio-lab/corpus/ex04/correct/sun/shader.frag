#version 330 core
in vec3 Normal;
in vec2 TexCoords;
out vec4 FragColor;
uniform vec3 sunDirection;
uniform vec3 lightColor;
uniform sampler2D diffuseMap;

void main()
{
    vec3 towards = normalize(-sunDirection);
    float lambert = max(dot(normalize(Normal), towards), 0.0);
    FragColor = vec4(lambert * lightColor * texture(diffuseMap, TexCoords).rgb, 1.0);
}
