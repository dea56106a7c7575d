#version 150
in vec3 position;
in vec3 normal;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM;
out vec3 N;
out vec3 L;
void main()
{
	vec4 w = M * vec4(position, 1.0);
	N = normalize(vec3(itM * vec4(normal, 0.0)));
	L = vec3(0.5, 0.5, -0.7) - w.xyz;
	gl_Position = P * V * w;
}
