#version 150
in vec3 posMonde;
in vec3 normaleMonde;
uniform vec3 u_view_pos;
uniform samplerCube cubemapSampler; // unité 0
out vec4 FragColor;
// rayon qui part de la caméra
vec3 rayon(){ return normalize(posMonde - u_view_pos); }
void main(){
	vec3 n = normalize(normaleMonde);
	vec3 reflet = reflect(rayon(), n);
	// vec3 reflet = refract(rayon(), n, 1.0/1.52); // ex10
	FragColor = texture(cubemapSampler, n);
}
