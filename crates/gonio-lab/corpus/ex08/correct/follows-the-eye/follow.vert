#version 440 core
layout(location = 0) in vec3 position;
uniform mat4 V;
uniform mat4 P;
uniform vec3 u_view_pos;
out vec3 dir;
void main()
{
	dir = position;
	gl_Position = P * V * vec4(position + u_view_pos, 1.0);
	gl_Position = gl_Position.xyww;
}
