#version 440 core
in Mirror { vec3 position; vec3 normal; } i;
layout(binding = 0) uniform samplerCube skybox;
uniform vec3 viewPos;
layout(location = 0) out vec4 FragColor;
void main()
{
    FragColor = textureLod(skybox, reflect(normalize(i.position - viewPos), normalize(i.normal)), 0.0);
}
