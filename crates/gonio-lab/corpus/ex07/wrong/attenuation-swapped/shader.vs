#version 330
layout(location=0) in vec3 a_Position;
layout(location=1) in vec2 tex_coords;
layout(location=2) in vec3 a_Normal;
out vec3 vPos;
out vec3 vNormal;
uniform mat4 M; uniform mat4 itM; uniform mat4 V; uniform mat4 P;
// TODO clean
void main(){
	vec4 frag_coord = M*vec4(a_Position, 1.0);
	gl_Position = P*V*frag_coord;
	vNormal = normalize(vec3(itM * vec4(a_Normal, 1.0)));
	vPos = frag_coord.xyz;
}
