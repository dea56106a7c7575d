#version 460
precision highp float;
layout(location = 0, index = 0) out vec4 FragColor;
uniform struct { vec3 colour; float k; } material;
float s = 3;
void main() { FragColor = vec4(material.colour * material.k / s, 1).rgba; FragColor.r = s.x; }
