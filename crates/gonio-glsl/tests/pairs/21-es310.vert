#version 310 es
layout(location = 0) in vec3 position;
layout(location = 0) uniform mat4 MVP;
layout(location = 0) out vec3 v;
void main() { v = position; gl_Position = MVP * vec4(position, 1.0); }
