#version 330 core
in vec3 a_Position;
in vec3 a_Normal;
uniform mat4 u_Model;
uniform mat4 u_View;
uniform mat4 u_Projection;
uniform mat4 u_Normal;
out vec3 worldPosition;
out vec3 worldNormal;
vec3 toWorld(vec3 p) { return (u_Model * vec4(p, 1.0)).xyz; }
// TODO clean
void main() {
  worldPosition = a_Position;
  worldNormal = normalize((u_Normal * vec4(a_Normal, 0.0)).xyz);
  gl_Position = u_Projection * u_View * vec4(toWorld(a_Position), 1.0);
}
