#version 330 core
in vec3 Wpos;
in vec3 Wnorm;
uniform vec3 WeyePos;
uniform vec3 WlightPos;
uniform vec3 materialColour;
uniform float shininess;
out vec4 fragColor;
void main()
{
    vec3 N = normalize(Wnorm);
    vec3 L = normalize(WlightPos - Wpos);
    vec3 E = normalize(WeyePos - Wpos);
    vec3 R = reflect(-L, N);
    fragColor = vec4(materialColour * (max(dot(N, L), 0.0) * pow(max(dot(R, E), 0.0), shininess)), 1.0);
}
