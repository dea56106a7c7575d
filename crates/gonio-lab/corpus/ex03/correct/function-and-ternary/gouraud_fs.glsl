#version 440
in vec3 v_col;
in vec2 v_t;
out vec4 FragColor;
void main()
{
	FragColor = vec4(v_col, 1);
}
