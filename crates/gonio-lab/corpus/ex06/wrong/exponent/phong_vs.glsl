#version 440 core
in vec3 position;
in vec3 normal;
in vec2 tex_coord;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM;
out vec3 v_pos;
out vec3 v_normal;
out vec2 v_tex;
// ------------
void main()
{
   v_pos = (M * vec4(position,1.0)).xyz;
   v_normal = (itM * vec4(normal,1.0)).xyz;
   v_normal = normalize(v_normal);
   v_tex = tex_coord;
   gl_Position = P * V * M * vec4(position,1.0);
}
