#version 120
attribute vec3 position;
attribute vec3 normal;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM;
varying vec3 v_frag_coord;
varying vec3 v_normal;

void main() {
  vec4 w = M * vec4(position, 1.0);
  v_frag_coord = w.xyz;
  v_normal = normalize((itM * vec4(normal, 0.0)).xyz);
  gl_Position = P * V * w;
}
