#version 330 core
out vec4 FragColor;
precision mediump float; 
in vec3 v_frag_coord; 
in vec3 v_norm; 
uniform vec3 u_light_pos; 
void main() { 
	vec3 N = normalize(v_norm);
	vec3 L = normalize(u_light_pos - v_frag_coord) ; 
	float diffuse = max(dot(N,L),0.0);
	FragColor = vec4(vec3(diffuse), 1.0); 
}
