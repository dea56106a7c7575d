#version 110
attribute vec3 a_Position;
attribute vec3 a_Normal;

uniform mat4 u_Model;
uniform mat4 u_View;
uniform mat4 u_Projection;
uniform mat4 u_Normal; // inverse transpose of u_Model

varying vec3 v_Normal;
varying vec3 v_Position;

void main() {
  v_Normal = (u_Normal * vec4(a_Normal, 0.0)).xyz;
  vec4 world = u_Model * vec4(a_Position, 1.0);
  v_Position = world.xyz;
  gl_Position = u_Projection * u_View * world;
}
