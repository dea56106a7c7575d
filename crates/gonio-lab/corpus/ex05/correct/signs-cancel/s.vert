#version 150
in vec3 position;
in vec3 normal;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM;
uniform vec3 lightPos;
uniform vec3 camPos;
uniform vec3 materialColour;
out vec3 v_col;
void main()
{
	vec3 w = vec3(M * vec4(position, 1.0));
	vec3 n = normalize(mat3(itM) * normal);
	vec3 l = normalize(lightPos - w);
	vec3 view = normalize(w - camPos);
	float spec = pow(max(dot(reflect(l, n), view), 0.0), 32.0);
	v_col = (max(dot(n, l), 0.0) + spec) * materialColour;
	gl_Position = P * V * vec4(w, 1.0);
}
