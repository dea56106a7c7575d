#version 300 es
in vec3 position;
in vec3 normal;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM;
uniform vec3 lightPos;
uniform vec3 materialColour;
out vec3 v_col;
void main()
{
    vec4 w = M * vec4(position, 1.0);
    vec3 n = normalize(mat3(itM) * normal);
    vec3 l = normalize(lightPos - w.xyz);
    v_col = materialColour * (0.5 * dot(n, l) + 0.5);
    gl_Position = P * V * w;
}
