#version 330 core
in vec3 position; in vec3 normal; in vec2 tex_coord;
uniform mat4 M; uniform mat4 itM; uniform mat4 V; uniform mat4 P;
out vec3 v_normal;
   out vec3 v_frag_coord;
// out vec3 v_color;
void main(){
      vec4 temp = M*vec4(position,1.0);
  v_frag_coord = vec3(temp.x,temp.y,temp.z);
        vec4 norm4 = itM*vec4(normal,1.0);
  vec3 norm = vec3(norm4.x,norm4.y,norm4.z);
   v_normal = norm/length(norm);
gl_Position=P*V*temp;
   // v_color = vec3(1,0,0);
}
