#version 330 core
out vec4 FragColor;
precision mediump float;
in float v_diffuse;
uniform vec3 materialColour;
void main() {
  FragColor = vec4(materialColour*v_diffuse, 1.0);
}
