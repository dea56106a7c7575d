#version 310 es
precision highp float;
layout(location = 0) in vec3 v;
layout(location = 0) out vec4 o;
layout(binding = 1) uniform sampler2D s;
void main() { o = texture(s, v.xy); }
