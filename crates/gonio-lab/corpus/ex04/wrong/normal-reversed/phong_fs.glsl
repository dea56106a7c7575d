#version 410
in vec3 n, l;
uniform vec3 materialColour;
out vec4 FragColor;

void main()
{
  float c = max(dot(normalize(n), normalize(l)), 0.0);
  FragColor = vec4(c * materialColour, 1.0);
}
