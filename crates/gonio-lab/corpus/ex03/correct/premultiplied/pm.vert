#version 150
in vec3 position;
in vec3 normal;
uniform mat4 MVP;
uniform mat4 M;
uniform mat4 itM;
uniform vec3 lightPos;
uniform vec3 materialColour;
out vec4 vertColour;
void main()
{
    vec3 toLight = lightPos - (M * vec4(position, 1.0)).xyz;
    vec3 n = (itM * vec4(normal, 0.0)).xyz;
    float c = dot(n, toLight) / (length(n) * length(toLight)); // cos = a.b / |a||b|
    vertColour = vec4(materialColour * max(c, 0.0), 1.0);
    gl_Position = MVP * vec4(position, 1.0);
}
