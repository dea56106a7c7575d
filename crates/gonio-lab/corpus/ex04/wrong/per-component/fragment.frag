#version 460 core
in vec3 p3, n3;
uniform vec3 lightPos, materialColour;
out vec4 FragColor;
void main() {
	vec3 incoming = normalize(p3 - lightPos);
	FragColor = vec4(max(-normalize(n3) * incoming, 0) * materialColour, 1);
}
