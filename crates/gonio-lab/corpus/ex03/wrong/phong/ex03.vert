#version 330 core
in vec3 position;
in vec3 normal;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM;
out vec3 v_normal;
out vec3 v_frag_coord;
void main() {
	v_frag_coord = vec3(M * vec4(position, 1.0));
	v_normal = normalize(vec3(itM * vec4(normal, 0.0)));
	gl_Position = P * V * vec4(v_frag_coord, 1.0);
}
