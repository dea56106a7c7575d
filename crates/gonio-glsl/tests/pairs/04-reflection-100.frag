#version 100
#extension GL_EXT_shader_texture_lod : enable
precision mediump float;
varying vec3 v_normal;
varying vec3 v_pos;
uniform samplerCube u_cubemap;
uniform vec3 camPos;
void main() {
  lowp vec3 I = normalize(v_pos - camPos);
  vec3 R = reflect(I, normalize(v_normal));
  gl_FragColor = vec4(textureCube(u_cubemap, R).rgb, 1.0);
}
