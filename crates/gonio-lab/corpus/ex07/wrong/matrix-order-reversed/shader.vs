#version 440 core
in vec3 a_Position;
in vec3 a_Normal;
in vec2 tex_coord;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM;
out vec3 vNormal;
out vec3 vPos;
out vec2 v_tex;


void main()
{
    v_tex = vec2(tex_coord.x, 1.0 - tex_coord.y);
    vNormal = normalize(mat3(itM) * a_Normal);
    vPos = (M * vec4(a_Position, 1.0)).xyz;
    gl_Position = M * V * P * vec4(a_Position, 1.0);
}
