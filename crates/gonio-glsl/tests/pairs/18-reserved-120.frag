#version 120
varying vec3 smooth;
uniform float flat;
mat3 inverse(mat3 m) { return m; }
void main() { float patch = 1; gl_FragColor = vec4(inverse(mat3(1.0)) * smooth * flat, patch); }
