#version 110
uniform samplerCube u_cubemap;
varying vec3 v_dir;
// TODO clean
void main() {
  gl_FragColor = textureCube(u_cubemap, v_dir);
}
