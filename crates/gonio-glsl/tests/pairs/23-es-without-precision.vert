#version 100
attribute vec3 position;
uniform mat4 u_mvp;
varying vec3 v_col;
void main() { v_col = position + 1.0; gl_Position = u_mvp * vec4(position, 1); }
