#version 150
in vec3 a_Position;
in vec3 a_Normal;
uniform mat4 MVP;
uniform mat4 M;
uniform mat4 itM;
uniform vec3 lightPos;
uniform vec3 materialColour;
out vec4 vertColour;
// ------------
void main()
{
    vec3 toLight = lightPos - (M * vec4(a_Position, 1.0)).xyz;
    vec3 n = (itM * vec4(a_Normal, 0.0)).xyz;
    float c = dot(n, toLight) / (length(n) * length(toLight));
    vertColour = vec4(materialColour * abs(c), 1.0);
    gl_Position = MVP * vec4(a_Position, 1.0);
}
