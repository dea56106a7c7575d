#version 300 es
precision highp float;
in vec3 aPos;
in vec3 aNormal;
uniform mat4 model;
uniform mat4 view;
uniform mat4 projection;
uniform mat4 itM;
out vec3 v_frag_coord;
out vec3 v_normal;


void main() {
	vec4 frag_coord = model * vec4(aPos, 1.0);
	gl_Position = projection * view * frag_coord;
	v_normal = normalize(vec3(itM * vec4(aNormal, 0.0)));
	v_frag_coord = frag_coord.xyz;
}
