#include <glad/glad.h>
#include <GLFW/glfw3.h>
#include <iostream>

const char* vertexShaderSource = R"glsl(#version 460 core
in vec3 aPos;
in vec3 aNormal;
in vec2 tex_coords;

// matrices envoyées par le programme
uniform mat4 model;
uniform mat4 view;
uniform mat4 projection;
uniform mat4 itM;   // inverse transposée de model

out vec3 v_normal;
out vec3 v_pos;     // aPos dans le monde

void main(){
  vec4 posMonde = model*vec4(aPos,1.0);
  v_pos = posMonde.xyz;
  // le 0.0 pour ne pas translater la normale
  v_normal = (itM*vec4(aNormal,0.0)).xyz;
  v_normal = normalize(v_normal);
  gl_Position = projection*view*posMonde;
}
)glsl";

const char* fragmentShaderSource = R"glsl(#version 460 core
in vec3 v_normal;
in vec3 v_pos;
out vec4 FragColor;

uniform vec3 u_view_pos;
uniform float shininess;
uniform vec3 materialColour;

struct Light{
  vec3 light_pos;
  float ambient_strength;
  float diffuse_strength;
  float specular_strength;
  float constant;
  float linear;
  float quadratic;
};
uniform Light light;

// lumière diffuse
float diffuse(vec3 n, vec3 l){
  return light.diffuse_strength*max(dot(n,l),0.0);
}

// lumière spéculaire : pas de reflet si la lumière est derrière
float speculaire(vec3 n, vec3 l, vec3 oeil){
  if(dot(n,l) <= 0.0){
    return 0.0;
  }
  vec3 r = 2.0*dot(n,l)*n - l;
  return light.specular_strength*pow(max(dot(r,oeil),0.0),shininess);
}

// atténuation avec la distance
float attenuation(float d){
  return 1.0/(light.constant + light.linear*d + light.quadratic*d*d);
}

void main(){
  vec3 n = normalize(v_normal);
  vec3 l = normalize(light.light_pos - v_pos);
  vec3 oeil = normalize(u_view_pos - v_pos);
  float d = distance(light.light_pos, v_pos);
  float lumiere = light.ambient_strength + attenuation(d)*diffuse(n,l);
  FragColor = vec4(materialColour*lumiere, 1.0);
  //FragColor = vec4(n*0.5+0.5, 1.0); // debug
}
)glsl";

int main() {
    glfwInit();
    // ...
    return 0;
}
