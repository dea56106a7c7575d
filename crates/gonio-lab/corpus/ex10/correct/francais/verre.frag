#version 330 core
in vec3 posMonde;
in vec3 normaleMonde;
uniform vec3 u_view_pos;
uniform samplerCube cubemapSampler;
uniform float refractionIndice; // verre : 1.52
out vec4 FragColor;
const float AIR = 1.0;
void main(){
    vec3 regard = normalize(posMonde - u_view_pos);
    vec3 n = normalize(normaleMonde);
    // de l'air vers le verre
    vec3 transmis = refract(regard, n, AIR/refractionIndice);
    FragColor = texture(cubemapSampler, transmis);
}
