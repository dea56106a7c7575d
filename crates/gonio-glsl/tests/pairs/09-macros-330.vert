#version 330
#define POS 0
#define SCALE 2
#define TRANSFORM(p) (P * V * M * vec4((p), 1))
#define HALF(x) ((x) / 2)
layout(location = POS) in vec3 position;
uniform mat4 M, V, P;
out vec3 v_col;
void main() {
#ifdef GL_ES
  broken here
#elif __VERSION__ >= 330
  v_col = HALF(position + 1) * SCALE;
#else
  v_col = position;
#endif
  float s = SCALE;
  for (int i = 0; i < SCALE; ++i) v_col *= HALF(s);
  gl_Position = TRANSFORM(position * s \
     / SCALE);
}
