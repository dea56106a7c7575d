#version 460
layout(location = 0) in vec3 position;
out gl_PerVertex { vec4 gl_Position; };
uniform mat4 model = mat4(1), view = mat4(1), projection;;
void main() { gl_Position = projection * view * model * vec4(position, 1); }
