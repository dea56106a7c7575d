#version 110
attribute vec3 a_Position;
attribute vec3 a_Normal;
uniform mat4 u_Model;
uniform mat4 u_View;
uniform mat4 u_Projection;
uniform mat4 u_Normal;
uniform vec3 u_light_pos;
varying vec4 v_col;
void main() {
  vec3 N = normalize(vec3(u_Normal * vec4(a_Normal, 0.0)));
  vec4 P = u_Model * vec4(a_Position, 1.0);
  vec3 L = normalize(u_light_pos - P.xyz);
  float c = max(dot(N, L), 0.0);
  v_col = vec4(c, c, c, 1.0);
  gl_Position = u_Projection * u_View * P;
}
