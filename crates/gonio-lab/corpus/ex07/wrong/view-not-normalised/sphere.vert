#version 150
in vec3 position;
in vec3 normal;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM;
out vec3 worldPos;
out vec3 worldNormal;
void main()
{
	worldPos = (M * vec4(position, 1.0)).xyz;
	worldNormal = normalize(mat3(itM) * normal);
	gl_Position = (P * V) * vec4(worldPos, 1.0);
}
