#version 130
in vec3 position;
in vec3 normal;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM;
out vec3 v_pos;
out vec3 v_norm;
void main()
{
    v_norm = normalize((itM * vec4(normal, 0.0)).xyz);
    vec4 w = M * vec4(position, 1.0);
    v_pos = w.xyz / w.w;
    gl_Position = P * (V * w);
}
