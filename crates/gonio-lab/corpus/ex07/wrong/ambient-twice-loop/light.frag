#version 400
in vec3 v_frag_coord;
in vec3 v_normal;
out vec4 outColor;
struct Light {
	vec3 light_pos;
	float ambient_strength;
	float diffuse_strength;
	float specular_strength;
	float constant;
	float linear;
	float quadratic;
};
const int N_LIGHTS = 2;
uniform Light lights[N_LIGHTS];
uniform vec3 u_view_pos;
uniform vec3 materialColour;
uniform float shininess;



void main(){
	vec3 N = normalize(v_normal);
	vec3 V = normalize(u_view_pos - v_frag_coord);
	vec3 sum = vec3(0.0, 0.0, 0.0);
	for(int i = 0; i < N_LIGHTS; ++i){
		vec3 toLight = lights[i].light_pos - v_frag_coord;
		vec3 L = normalize(toLight);
		float dist = length(toLight);
		float att = 1.0/(lights[i].constant + lights[i].linear*dist + lights[i].quadratic*pow(dist, 2.0));
		float diffuse = max(dot(N,L), 0.0)*lights[i].diffuse_strength;
		float specular = pow(max(dot(reflect(-L,N), V), 0.0), shininess)*lights[i].specular_strength;
		sum += (lights[i].ambient_strength + (diffuse + specular)*att)*materialColour;
	}
	sum += (lights[0].ambient_strength + lights[1].ambient_strength)*materialColour;
	outColor = vec4(sum, 1.0);
}
