#version 120
varying float v_light;
// TODO clean
void main()
{
  gl_FragColor = vec4(v_light, v_light, v_light, 1.0);
}
