#version 460 core
in vec3 posMonde;
in vec3 normaleMonde;
uniform vec3 viewPos;
uniform samplerCube cubemapSampler;
uniform float refractionIndice; // verre : 1.52
out vec4 fragColor;
const float AIR = 1.0;
// TODO clean
void main(){
	vec3 regard = normalize(posMonde - viewPos);
	vec3 n = normalize(normaleMonde);
	// de l'air vers le verre
	vec3 transmis = refract(regard, n, AIR/refractionIndice);
	fragColor = texture(cubemapSampler, transmis);
}
