#version 430
layout(location = 3) in vec3 v_col;
layout(location = 0) out vec4 FragColor;
layout(location = 1) uniform float now;
void main() {
  FragColor = vec4(v_col, 1) * abs(sin(now)); // end
}