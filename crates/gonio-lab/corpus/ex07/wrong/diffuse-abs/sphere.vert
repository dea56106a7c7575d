#version 130
in vec3 aPos;
in vec3 aNormal;
uniform mat4 model;
uniform mat4 view;
uniform mat4 projection;
uniform mat4 itM;
out vec3 v_pos;
out vec3 v_norm;
void main()
{
	v_norm = normalize((itM * vec4(aNormal, 0.0)).xyz);
	vec4 w = model * vec4(aPos, 1.0);
	v_pos = w.xyz / w.w;
	gl_Position = projection * (view * w);
}
