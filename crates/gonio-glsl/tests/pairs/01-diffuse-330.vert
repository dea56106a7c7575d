#version 330 core
in vec3 position;
in vec2 tex_coords;
in vec3 normal;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM;
uniform vec3 u_light_pos;
out float v_diffuse;
void main(){
  vec4 frag_coord = M*vec4(position, 1.0);
  gl_Position = P*V*frag_coord;
  vec4 norm = itM * vec4(normal, 1.0);
  vec3 L = normalize(u_light_pos - frag_coord.xyz);
  v_diffuse = max(dot(normalize(norm.xyz), L), 0);
}
