#version 120
attribute vec3 position, normal;
uniform mat4 M, V, P;
varying vec3 v_normal;
mat3 cofactors(mat3 m) { return mat3(cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])); }
void main() { v_normal = cofactors(mat3(M)) * normal; gl_Position = P * V * M * vec4(position, 1); }
