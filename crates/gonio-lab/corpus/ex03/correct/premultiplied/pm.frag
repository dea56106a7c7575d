#version 150
in vec4 vertColour;
out vec4 fragColour;
void main()
{
    fragColour = vertColour;
}
