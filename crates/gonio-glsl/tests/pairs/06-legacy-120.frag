#version 120
varying vec3 N, v;
varying vec2 uv;
uniform sampler2D texture;
uniform vec3 lightPos;
void main() {
  vec3 L = normalize(lightPos - v);
  vec4 Idiff = vec4(1, 1, 1, 1) * max(dot(N, L), 0);
  gl_FragColor = texture2D(texture, uv) * Idiff + gl_Color * texture2D(texture, gl_TexCoord[0].xy);
  gl_FragColor.a = 1;
}
