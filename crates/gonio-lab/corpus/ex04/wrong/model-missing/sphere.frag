#version 330 core
in vec3 normale;
in vec3 pos;
uniform vec3 u_light_pos;
uniform vec3 materialColour;
out vec4 couleur;
const float AMBIANT = 0.1;
const float DIFFUS = 0.8;
float cosinusLumiere(vec3 n){
  vec3 l = normalize(u_light_pos - pos);
  return max(dot(n,l),0.0);
}
void main(){
  vec3 n = normalize(normale);
  couleur = vec4(materialColour*(AMBIANT + DIFFUS*cosinusLumiere(n)), 1.0);
}
