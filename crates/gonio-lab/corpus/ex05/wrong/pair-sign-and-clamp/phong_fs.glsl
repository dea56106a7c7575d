#version 300 es
precision mediump float;
in float v_diffuse;
in float v_specular;
uniform vec3 materialColour;
out vec4 FragColor;


void main() { FragColor = vec4(materialColour * (v_diffuse + v_specular), 1.0); }
