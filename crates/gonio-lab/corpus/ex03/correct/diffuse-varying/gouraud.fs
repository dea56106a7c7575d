#version 330 core
in float v_diffuse;
uniform vec3 materialColour;
out vec4 FragColor;
void main()
{
    FragColor = vec4(v_diffuse * materialColour, 1.0);
}
