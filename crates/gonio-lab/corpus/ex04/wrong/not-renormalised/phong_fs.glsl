#version 400 core
precision mediump float;
in vec3 n;
in vec3 fragCoord;
out vec4 frag_color;
uniform vec3 u_light_pos;
uniform vec3 materialColour;

void main() {
	vec3 N = n;
	vec3 L = normalize(u_light_pos - fragCoord);
	float diffuse = max(dot(N, L), 0.0);
	frag_color = vec4(materialColour * diffuse, 1.0);
}
