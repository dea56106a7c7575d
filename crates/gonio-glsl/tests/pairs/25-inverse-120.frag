#version 120
varying vec3 v_normal;
void main() {
  float gl_kind = 1; float a__b = 2;
  gl_FragColor = vec4(normalize(v_normal) / 2 + 0.5, 1) * gl_kind * a__b;
}
