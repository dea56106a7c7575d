#version 330 core
in vec3 position;
in vec3 normal;
in vec2 tex_coords;

// matrices envoyées par le programme
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM;   // inverse transposée de M

out vec3 v_normal;
out vec3 v_pos;     // position dans le monde



void main()
{
  vec4 posMonde = M*vec4(position,1.0);
  v_pos = posMonde.xyz;
  // le 0.0 pour ne pas translater la normale
  v_normal = (itM*vec4(normal,0.0)).xyz;
  v_normal = normalize(v_normal);
  gl_Position = P*V*posMonde;
}
