#version 440
in vec3 position;
in vec3 normal;
in vec2 tex_coords;
uniform mat4 M;
uniform mat4 itM;
uniform mat4 V;
uniform mat4 P;
uniform vec3 u_light_pos;
uniform vec3 materialColour;
out vec3 v_col;
out vec2 v_t;

float lambert(vec3 n, vec3 l)
{
	float c = dot(n, l);
	return c > 0 ? c : 0;
}

void main()
{
	vec3 world = (M * vec4(position, 1)).xyz;
	vec3 n = normalize((itM * vec4(normal, 0)).xyz);
	vec3 l = normalize(u_light_pos - world);
	v_col = lambert(n, l) * materialColour;
	v_t = tex_coords;
	gl_Position = P * V * M * vec4(position, 1);
}
