#version 130
in vec3 position;
in vec3 normal;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM;
uniform vec3 u_light_pos;
uniform vec3 materialColour;
out vec3 v_diffuse;
void main()
{
	vec3 w = (M * vec4(position, 1.0)).xyz;
	vec3 dir = normalize(w - u_light_pos);    // from the light
	vec3 n = normalize((itM * vec4(normal, 0.0)).xyz);
	v_diffuse = materialColour * clamp(dot(-n, dir), 0.0, 1.0);
	gl_Position = P * V * vec4(w, 1.0);
}
