#version 400 core
in vec3 position;
in vec2 tex_coord;
in vec3 normal;

out vec3 FragPos;
out vec3 Normal;

uniform mat4 M;
uniform mat4 itM;
uniform mat4 V;
uniform mat4 P;


void main() {
  vec4 frag_coord = M * vec4(position, 1.0);
  gl_Position = P * V * frag_coord;
  Normal = normalize(vec3(itM * vec4(normal, 0.0)));
  FragPos = frag_coord.xyz;
}
