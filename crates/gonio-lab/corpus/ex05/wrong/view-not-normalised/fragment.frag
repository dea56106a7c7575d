#version 400 core
out vec4 color_out;
precision mediump float;
in float v_diffuse;
in float v_specular;
uniform vec3 materialColour;
// TODO clean
void main() {
  color_out = vec4(materialColour * (v_diffuse + v_specular), 1.0);
}
