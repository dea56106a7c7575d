#version 430
layout(location = 0) in vec3 position;
layout(location = 0) uniform mat4 MVP;
layout(location = 3) out vec3 v_col;
void main() {
  v_col = position * 0.5 + 0.5;
  gl_Position = MVP * vec4(position, 1);
}
