#version 120
attribute vec3 position;
uniform mat4 sample;
varying vec3 smooth;
float round(float x) { return floor(x + 0.5); }
void main() { smooth = position * round(1.2); gl_Position = sample * vec4(position, 1); }
