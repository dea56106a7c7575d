#version 330 core
in vec3 position;
in vec3 normal;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM;
out vec3 fragPos;
out vec3 fragNormal;
// TODO clean
void main()
{
	vec4 world = M * vec4(position, 1.0);
	fragPos = world.xyz;
	fragNormal = normalize(mat3(itM) * normal);
	gl_Position = P * V * world;
}
