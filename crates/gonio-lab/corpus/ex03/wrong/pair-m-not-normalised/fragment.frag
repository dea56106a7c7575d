#version 400 core
out vec4 outColor;
precision mediump float;
in vec4 v_col;
// TODO clean
void main() {
	outColor = v_col;
}
