#version 460 core
out vec4 fragColor;

in vec3 LightingColor;

uniform vec3 objectColor;



void main()
{
   fragColor = vec4(LightingColor * objectColor, 1.0);
}
