#version 440 core
in vec4 v_col;
out vec4 color_out;
// ------------
void main()
{
	color_out = v_col;
}
