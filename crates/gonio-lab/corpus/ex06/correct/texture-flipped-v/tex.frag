#version 130
in vec2 v_t;
in vec3 v_n;
in vec3 v_p;
uniform sampler2D u_texture;
uniform vec3 u_light_pos;
uniform vec3 u_view_pos;
uniform float shininess;
out vec4 FragColor;
void main()
{
	//vec3 colour = texture(u_texture, v_t).rgb;
	const vec3 colour = vec3(0.5, 0.6, 0.8);
	vec3 n = normalize(v_n);
	vec3 l = normalize(u_light_pos - v_p);
	vec3 v = normalize(u_view_pos - v_p);
	vec3 r = reflect(-l, n);
	float diff = max(dot(n, l), 0.0);
	float spec = pow(max(dot(r, v), 0.0), shininess);
	FragColor = vec4(diff * colour + spec * colour, 1.0);
}
