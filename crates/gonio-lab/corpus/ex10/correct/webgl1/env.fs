#version 120
uniform samplerCube u_cubemap;
uniform vec3 u_view_pos;
uniform float refractionIndice;
varying vec3 v_Normal;
varying vec3 v_Position;
void main() {
  vec3 I = normalize(v_Position - u_view_pos);
  gl_FragColor = textureCube(u_cubemap, refract(I, normalize(v_Normal), 1.0 / refractionIndice));
}
