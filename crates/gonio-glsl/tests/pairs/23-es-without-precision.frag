#version 100
#ifdef GL_ES
precision mediump float;
#endif
varying vec3 v_col;
void main() { gl_FragColor = vec4(v_col * 0.5, 1); }
