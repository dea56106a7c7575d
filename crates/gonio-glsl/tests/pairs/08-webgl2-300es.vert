#version 300 es
in vec3 a_Position;
in vec3 u_Normal;
uniform mat4 u_Model;
uniform mat4 u_View, u_Projection;
out vec3 v_normal;
out highp vec3 v_pos;
void main() {
  v_pos = (u_Model * vec4(a_Position, 1.0)).xyz;
  v_normal = mat3(u_Model) * u_Normal;
  gl_Position = u_Projection * u_View * vec4(v_pos, 1.0);
}
