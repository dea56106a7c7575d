#version 330 compatibility
varying vec3 n;
void main() { gl_FragColor = vec4(normalize(n) * .5 + .5, 1); }
