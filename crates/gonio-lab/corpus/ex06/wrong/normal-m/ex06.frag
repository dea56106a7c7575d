#version 400 core
out vec4 FragColor;
precision mediump float;
in vec3 FragPos;
in vec3 Normal;
uniform vec3 lightPos;
uniform vec3 viewPos;
uniform vec3 materialColour;
// ------------
void main() {
	vec3 N = normalize(Normal);
	vec3 L = normalize(lightPos - FragPos);
	vec3 V = normalize(viewPos - FragPos);
	vec3 R = reflect(-L, N);
	float diffuse = max(dot(N, L), 0.0);
	float cosTheta = dot(R, V);
	float specular = pow(max(cosTheta, 0.0), 32.0);
	FragColor = vec4(materialColour * (diffuse + specular), 1.0);
}
