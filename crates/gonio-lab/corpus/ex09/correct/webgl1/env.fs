#version 110
uniform samplerCube u_cubemap;
uniform vec3 u_view_pos;
varying vec3 v_Normal;
varying vec3 v_Position;
void main() {
  vec3 I = normalize(v_Position - u_view_pos);
  gl_FragColor = textureCube(u_cubemap, reflect(I, normalize(v_Normal)));
}
