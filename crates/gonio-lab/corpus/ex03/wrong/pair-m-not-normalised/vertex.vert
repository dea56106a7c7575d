#version 330 core
in vec3 position;
in vec2 tex_coords;
in vec3 normal;
out vec4 v_col;
uniform mat4 M;
uniform mat4 itM;
uniform mat4 V;
uniform mat4 P;
uniform vec3 u_light_pos;
uniform vec3 materialColour;
// TODO clean
void main(){
	vec4 frag_coord = M*vec4(position, 1.0);
	gl_Position = P*V*frag_coord;
	vec4 norm = M * vec4(normal, 0.0);
	vec3 N = norm.xyz;
	vec3 L = normalize(u_light_pos - frag_coord.xyz);
	float diffuse = max(0.0, dot(N, L));
	v_col = vec4(materialColour * diffuse, 1.0);
}
