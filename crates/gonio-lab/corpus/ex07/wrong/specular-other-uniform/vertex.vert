#version 130
in vec3 position;
in vec3 normal;
in vec2 tex_coord;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM;
out vec3 v_normal;
out vec3 v_frag_coord;
out vec2 v_tex;
// ------------
void main()
{
  v_tex = vec2(tex_coord.x, 1.0 - tex_coord.y);
  v_normal = normalize(mat3(itM) * normal);
  v_frag_coord = (M * vec4(position, 1.0)).xyz;
  gl_Position = P * V * M * vec4(position, 1.0);
}
