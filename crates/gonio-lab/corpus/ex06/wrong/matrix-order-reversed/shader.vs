#version 130
in vec3 a_Position;
in vec3 a_Normal;
in vec2 tex_coord;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM;
out vec3 v_pos;
out vec3 vNormal;
out vec2 v_tex;
// ------------
void main()
{
   v_pos = (M * vec4(a_Position,1.0)).xyz;
   vNormal = (itM * vec4(a_Normal,1.0)).xyz;
   vNormal = normalize(vNormal);
   v_tex = tex_coord;
   gl_Position = M * V * P * vec4(a_Position,1.0);
}
