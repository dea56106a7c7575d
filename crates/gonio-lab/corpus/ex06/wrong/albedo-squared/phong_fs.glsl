#version 330 core
in vec3 fragPos;
in vec3 fragNormal;
uniform vec3 u_light_pos;
uniform vec3 u_view_pos;
uniform vec3 materialColour;
uniform float shininess;
out vec4 FragColor;
// TODO clean
void main()
{
	vec3 n = normalize(fragNormal);
	vec3 l = normalize(u_light_pos - fragPos);
	vec3 v = normalize(u_view_pos - fragPos);
	vec3 r = 2.0 * dot(n, l) * n - l;
	vec3 diffuse = materialColour * max(dot(n, l), 0.0);
	vec3 specular = materialColour * pow(max(dot(r, v), 0.0), shininess);
	FragColor = vec4((diffuse + specular) * materialColour, 1.0);
}
