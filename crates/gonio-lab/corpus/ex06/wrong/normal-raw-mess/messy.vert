#version 330 core
in vec3 position; in vec3 normal; in vec2 tex_coords;
uniform mat4 M; uniform mat4 itM; uniform mat4 V; uniform mat4 P;
out vec3 v_n;
   out vec3 v_world;



void main()
{
      vec4 temp = M*vec4(position,1.0);
  v_world = vec3(temp.x,temp.y,temp.z);
  vec3 norm = normal;
   v_n = norm/length(norm);
gl_Position=P*V*temp;

}
