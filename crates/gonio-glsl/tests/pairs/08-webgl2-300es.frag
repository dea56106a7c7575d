#version 300 es
precision mediump float;
in vec3 v_normal;
in highp vec3 v_pos;
uniform vec3 lightPos;
layout(location = 0) out vec4 outColor;
void main() {
  float d = max(dot(normalize(v_normal), normalize(lightPos - v_pos)), 0.0);
  outColor = vec4(vec3(0.1 + d), 1.0);
}
