uniform sampler2D ourTexture;
varying vec2 v_t;
void main() {
  int n = 3;
  float k = max(n, 2) / 2;
  gl_FragData[0] = texture2D(ourTexture, v_t, 0) * k;
  gl_FragData[1] = vec4(0);
}
