#version 330 core
in vec3 a_Position;
in vec2 tex_coord;
in vec3 a_Normal;

out vec3 vPos;
out vec3 vNormal;

uniform mat4 M;
uniform mat4 itM;
uniform mat4 V;
uniform mat4 P;


void main() {
  vec4 frag_coord = M * vec4(a_Position, 1.0);
  gl_Position = P * V * frag_coord;
  vNormal = normalize(vec3(itM * vec4(a_Normal, 0.0)));
  vPos = frag_coord.xyz;
}
