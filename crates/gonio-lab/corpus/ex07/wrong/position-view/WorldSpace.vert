#version 330 core
in vec3 MvertPos;
in vec3 MvertNormal;
uniform mat4 M, V, P, itM;
out vec3 WfragPos;
out vec3 WfragNormal;
// ------------
void main()
{
	WfragPos = vec3(V * M * vec4(MvertPos, 1.0));
	WfragNormal = normalize(vec3(itM * vec4(MvertNormal, 0.0)));
	gl_Position = P * vec4(WfragPos, 1.0);
}
