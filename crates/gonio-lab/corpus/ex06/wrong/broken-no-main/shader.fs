#version 120
varying vec3 v_frag_coord;
varying vec3 v_normal;
uniform vec3 u_light_pos;
uniform vec3 u_view_pos;
uniform vec3 materialColour;
uniform float shininess;
void mian() {
  vec3 N = normalize(v_normal);
  vec3 L = normalize(u_light_pos - v_frag_coord);
  vec3 V = normalize(u_view_pos - v_frag_coord);
  float diff = max(dot(N, L), 0.0);
  float spec = pow(max(dot(reflect(-L, N), V), 0.0), shininess);
  gl_FragColor = vec4((diff + spec) * materialColour, 1.0);
}
