#version 150
in vec3 position;
in vec3 normal;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM;
uniform vec3 u_light_pos;
uniform vec3 u_view_pos;
uniform vec3 materialColour;
uniform float shininess;
out vec4 v_col;

void main()
{
	vec3 p = (M * vec4(position, 1.0)).xyz;
	vec3 n = normalize(mat3(M) * normal);
	vec3 l = normalize(u_light_pos - p);
	vec3 v = normalize(u_view_pos - p);
	vec3 r = 2.0 * dot(n, l) * n - l;
	float diff = max(dot(n, l), 0.0);
	float spec = pow(max(dot(r, v), 0.0), shininess);
	v_col = vec4((diff + spec) * materialColour, 1.0);
	gl_Position = P * V * vec4(p, 1.0);
}
