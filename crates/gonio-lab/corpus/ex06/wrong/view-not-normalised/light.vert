#version 460 core
in vec3 position;
in vec3 normal;
out vec3 N;
out vec3 L;
out vec3 V_dir;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM;
uniform vec3 u_light_pos;
uniform vec3 u_view_pos;
// TODO clean
void main(){
	vec3 w = (M * vec4(position, 1.0)).xyz;
	N = mat3(itM) * normal;
	L = u_light_pos - w;
	V_dir = u_view_pos - w;
	gl_Position = P * V * vec4(w, 1.0);
}
