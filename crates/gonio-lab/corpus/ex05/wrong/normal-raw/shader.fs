#version 330 core
out vec4 frag_color;

in vec3 LightingColor;

uniform vec3 objectColor;


void main()
{
   frag_color = vec4(LightingColor * objectColor, 1.0);
}
