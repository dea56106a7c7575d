#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 tex_coords;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM;
out vec3 v_frag_coord;
out vec3 v_normal;
out vec2 texCoord_v;

void main()
{
  gl_Position = P * M * V * vec4(position, 1.0);
  v_frag_coord = vec3(M * vec4(position, 1.0));
  v_normal = normalize(vec3(itM * vec4(normal, 0.0)));
  texCoord_v = tex_coords;
}
