#version 150
in vec4 v_col;
out vec4 FragColor;

void main()
{
	FragColor = v_col;
}
