#version 400
in vec3 position;
in vec3 normal;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM;
out VS { vec3 position; vec3 normal; vec2 uv; } v;
void main()
{
	v.position = (M * vec4(position, 1)).xyz;
	v.normal = normalize(mat3(itM) * normal);
	v.uv = vec2(0);
	gl_Position = P * V * vec4(v.position, 1);
}
