#version 130
in vec3 v_diffuse;
out vec4 FragColor;
void main()
{
	FragColor = vec4(v_diffuse, 1.0);
}
