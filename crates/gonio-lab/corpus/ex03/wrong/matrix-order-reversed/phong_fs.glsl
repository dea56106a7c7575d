#version 410 core
out vec4 FragColor;

in vec3 LightingColor;

uniform vec3 objectColor;

// TODO clean
void main()
{
   FragColor = vec4(LightingColor * objectColor, 1.0);
}
