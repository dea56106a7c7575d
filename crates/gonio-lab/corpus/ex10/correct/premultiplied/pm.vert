#version 150
in vec3 position;
in vec3 normal;
uniform mat4 MVP;
uniform mat4 M;
uniform mat4 itM;
uniform vec3 camPos;
out vec3 v_ray;
out vec3 v_normal;
void main()
{
	gl_Position = MVP * vec4(position, 1.0);
	v_ray = vec3(M * vec4(position, 1.0)) - camPos; // not normalized: interpolated
	v_normal = normalize(vec3(itM * vec4(normal, 1.0)));
}
