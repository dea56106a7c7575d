#version 330 core
in vec3 direction;
out vec4 FragColor;
uniform samplerCube skybox;
uniform vec3 fogColour;

void main()
{
    vec4 sky = texture(skybox, direction);
    FragColor = mix(vec4(fogColour, 1.0), sky, clamp(4.0 * normalize(direction).y, 0.0, 1.0));
}
