#version 120
attribute vec3 a_Position;
attribute vec3 a_Normal;
uniform mat4 u_Model;
uniform mat4 u_View;
uniform mat4 u_Projection;
uniform mat4 u_Normal;
uniform vec3 u_light_pos;
uniform vec3 u_view_pos;
varying float v_light;
void main() {
  vec4 world = u_Model * vec4(a_Position, 1.0);
  vec3 N = normalize(vec3(u_Normal * vec4(a_Normal, 0.0)));
  vec3 L = normalize(u_light_pos - world.xyz);
  vec3 V = normalize(u_view_pos - world.xyz);
  vec3 R = reflect(-L, N);
  v_light = max(dot(N, L), 0.0) + pow(max(dot(R, V), 0.0), 32.0);
  gl_Position = u_Projection * u_View * world;
}
