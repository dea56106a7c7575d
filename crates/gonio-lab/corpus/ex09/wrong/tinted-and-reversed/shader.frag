#version 330 core
in vec3 FragPos;
in vec3 Normal;
out vec4 FragColor;
uniform vec3 viewPos;
uniform samplerCube skybox;

void main()
{
    vec3 towards = normalize(viewPos - FragPos);
    vec3 seen = reflect(towards, normalize(Normal));
    FragColor = vec4(0.2, 0.1, 0.0, 0.0) + 0.7 * texture(skybox, seen);
}
