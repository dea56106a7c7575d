#version 330 core
in vec3 N;
in vec3 L;
in vec3 V_dir;
uniform vec3 materialColour;
uniform float shininess;
out vec4 FragColor;
void main(){
	vec3 n = normalize(N);
	vec3 l = normalize(L);
	vec3 v = normalize(V_dir);
	float diff = max(dot(n, l), 0.0);
	float spec = pow(max(dot(v, reflect(-l, n)), 0.0), shininess);
	FragColor = vec4(materialColour * (diff + spec), 1.0);
}
