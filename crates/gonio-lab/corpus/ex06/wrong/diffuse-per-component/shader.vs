#version 130
in vec3 position;
in vec2 texcoord;
in vec3 normal;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM;
out vec2 v_t;
out vec3 v_n;
out vec3 v_p;


void main()
{
	v_t = vec2(texcoord.x, 1.0 - texcoord.y);
	v_n = normalize(mat3(itM) * normal);
	v_p = (M * vec4(position, 1.0)).xyz;
	gl_Position = P * V * M * vec4(position, 1.0);
}
