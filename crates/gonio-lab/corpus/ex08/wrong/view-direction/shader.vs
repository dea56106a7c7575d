#version 300 es
in vec3 aPos;
uniform mat4 view;
uniform mat4 projection;
out vec3 v_tex;
// TODO clean
void main() {
	v_tex = mat3(view) * aPos;
	vec4 p = projection * vec4(mat3(view) * aPos, 1.0);
	gl_Position = p;
	gl_Position.z = gl_Position.w;
}
