#version 120
attribute vec3 aPos;
attribute vec3 aNormal;
uniform mat4 model;
uniform mat4 view;
uniform mat4 projection;
uniform mat4 itM;
varying vec3 v_frag_coord;
varying vec3 v_normal;
void main() {
  vec4 w = model * vec4(aPos, 1.0);
  v_frag_coord = w.xyz;
  v_normal = normalize((itM * vec4(aNormal, 0.0)).xyz);
  gl_Position = projection * view * w;
}
