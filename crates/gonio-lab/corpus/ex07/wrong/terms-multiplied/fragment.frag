#version 300 es
precision mediump float;
out vec4 FragColor;
in vec3 v_frag_coord;
in vec3 v_normal;
uniform vec3 u_view_pos;
struct Light {
	vec3 light_pos;
	float ambient_strength;
	float diffuse_strength;
	float specular_strength;
	float constant;
	float linear;
	float quadratic;
};
uniform Light light;
uniform float shininess;
uniform vec3 materialColour;


void main() {
	vec3 N = normalize(v_normal);
	vec3 L = normalize(light.light_pos - v_frag_coord);
	vec3 view = normalize(u_view_pos - v_frag_coord);
	vec3 R = reflect(-L, N);
	float spec = light.specular_strength * pow(max(dot(R, view), 0.0), shininess);
	float diff = light.diffuse_strength * max(dot(N, L), 0.0);
	float d = length(light.light_pos - v_frag_coord);
	float att = 1.0 / (light.constant + light.linear * d + light.quadratic * d * d);
	FragColor = vec4(materialColour * (light.ambient_strength + att * (diff * spec)), 1.0);
}
