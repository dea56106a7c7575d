#version 150
in vec3 position;
in vec3 normal;
uniform mat4 MVP;
uniform mat4 M;
uniform mat4 itM;
out vec3 v_frag_coord;
out vec3 v_normal;

void main()
{
	gl_Position = MVP * vec4(position, 1.0);
	v_frag_coord = vec3(M * vec4(position, 1.0));
	v_normal = normalize(vec3(itM * vec4(position, 0.0)));
}
