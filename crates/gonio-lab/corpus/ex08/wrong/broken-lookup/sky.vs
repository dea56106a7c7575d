#version 110
attribute vec3 a_Position;
uniform mat4 u_View;
uniform mat4 u_Projection;
varying vec3 v_dir;
void main() {
  v_dir = a_Position;
  mat4 r = u_View;
  r[3] = vec4(0.0, 0.0, 0.0, 1.0);
  gl_Position = (u_Projection * r * vec4(a_Position, 1.0)).xyww;
}
