#version 400 core
in vec3 aPos;
in vec3 aNormal;
uniform mat4 MVP;
uniform mat4 model;
uniform mat4 itM;
out vec3 v_frag_coord;
out vec3 v_normal;
// ------------
void main() {
  v_frag_coord = (model*vec4(aPos,1)).xyz;
  v_normal = normalize((itM*vec4(aNormal,0)).xyz);
  gl_Position = MVP*vec4(aPos,1);
}
