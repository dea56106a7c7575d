#version 110
attribute vec3 a_Position;
attribute vec3 a_Normal;
uniform mat4 u_Model;
uniform mat4 u_View;
uniform mat4 u_Projection;
uniform mat4 u_Normal;
varying vec3 v_Normal;
varying vec3 v_Position;
void main() {
  vec4 w = u_Model * vec4(a_Position, 1.0);
  v_Position = w.xyz;
  v_Normal = normalize((u_Normal * vec4(a_Normal, 0.0)).xyz);
  gl_Position = u_Projection * u_View * w;
}
