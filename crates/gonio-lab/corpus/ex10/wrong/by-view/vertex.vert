#version 130
in vec3 position;
in vec3 normal;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM;
out vec3 pos;
out vec3 nor;


void main()
{
	pos = (M * vec4(position, 1.0)).xyz;
	nor = normalize(mat3(itM) * normal);
	gl_Position = P * V * vec4(pos, 1.0);
}
