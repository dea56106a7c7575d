#version 440 core
in Glass { vec3 position; vec3 normal; } i;
uniform samplerCube skybox;
uniform vec3 viewPos;
uniform float refractionIndice;
layout(location = 0) out vec4 FragColor;
void main()
{
  FragColor = texture(skybox, refract(normalize(i.position - viewPos), normalize(i.normal), 1.0 / refractionIndice));
}
