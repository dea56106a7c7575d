#version 460 core
in vec3 position;
in vec3 normal;
uniform mat4 M, V, P, itM;
out vec3 posMonde;
out vec3 normaleMonde;
// TODO clean
void main(){
	vec4 p = M*vec4(position,1.0);
	posMonde = (V*p).xyz;
	normaleMonde = normalize(vec3(itM*vec4(normal,0.0)));
	gl_Position = P*V*p;
}
