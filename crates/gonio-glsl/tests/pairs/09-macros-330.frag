#version 330
#ifndef PI
#define PI 3.14159265
#endif
#define SATURATE(x) clamp(x, 0, 1)
#define OUT FragColor
in vec3 v_col;
out vec4 OUT;
void main() {
  OUT = vec4(SATURATE(v_col), 1) * (PI / 3);
}
