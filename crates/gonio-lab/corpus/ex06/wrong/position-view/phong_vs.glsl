#version 330
in vec3 a_Position;
in vec3 a_Normal;
uniform mat4 model;
uniform mat4 view;
uniform mat4 projection;
out vec3 world;
out vec3 nrm;
void main(void) {
	world = vec3(view * model * vec4(a_Position, 1.0));

	mat3 nm = mat3(transpose(inverse(model)));
	nrm = normalize(nm * a_Normal);
	gl_Position = projection * vec4(world, 1.0);
}
