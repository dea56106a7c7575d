#version 300 es
in vec3 a_Position;
in vec3 a_Normal;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM;
out vec3 vNormal;
out vec3 v_pos;
// ------------
void main()
{
    vec4 w = M * vec4(a_Position, 1.0);
    v_pos = w.xyz;
    vNormal = normalize(mat3(V * M) * a_Normal);
    gl_Position = P * V * w;
}
