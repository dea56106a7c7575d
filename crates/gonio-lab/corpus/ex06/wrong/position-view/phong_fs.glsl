#version 330
in vec3 world;
in vec3 nrm;
uniform vec3 u_light_pos;
uniform vec3 camPos;
uniform vec3 materialColour;
out vec4 color_out;
void main(void) {
	color_out = vec4(0.0, 0.0, 0.0, 1.0);
	vec3 n = normalize(nrm);
	vec3 l = normalize(u_light_pos - world);
	float nl = dot(n, l);
	if (nl <= 0.0) return;
	color_out.rgb += materialColour * nl;
	vec3 e = normalize(camPos - world);
	float re = dot(reflect(-l, n), e);
	if (re <= 0.0) return;
	color_out.rgb += materialColour * pow(re, 32.0);
}
