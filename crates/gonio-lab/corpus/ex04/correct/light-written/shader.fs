#version 150
in vec3 N;
in vec3 L;
out vec4 FragColor;
void main()
{
	float d = max(0.0, dot(normalize(N), normalize(L)));
	FragColor = vec4(d, d, d, 1.0);
}
