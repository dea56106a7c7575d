#version 330 core
in vec3 position;
in vec3 normal;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM;
out vec3 normale;
out vec3 pos;
void main(){
  gl_Position = P*V*M*vec4(position,1.0);

  normale = normalize(mat3(itM)*normal);
  pos = vec3(M*vec4(position,1.0));
}
