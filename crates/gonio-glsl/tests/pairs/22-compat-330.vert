#version 330 compatibility
varying vec3 n;
void main() { n = gl_NormalMatrix * gl_Normal; gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex; }
