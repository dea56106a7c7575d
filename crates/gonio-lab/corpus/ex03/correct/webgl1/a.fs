#version 110
varying vec4 v_col;
void main() {
  gl_FragColor = v_col;
}
