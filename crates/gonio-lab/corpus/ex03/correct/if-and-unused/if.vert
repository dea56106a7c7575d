#version 330 core
in vec3 position;
in vec3 normal;
in vec2 texcoord;
uniform mat4 M;
uniform mat4 itM;
uniform mat4 V;
uniform mat4 P;
uniform float now;
uniform vec3 u_light_pos;
uniform vec3 u_view_pos;  // for ex05
uniform vec3 materialColour;
out vec3 v_col;
out vec2 v_tex;
out vec3 v_normal;
void main(){
      v_tex=texcoord;
  v_normal=normal;
   vec3 P3=vec3(M*vec4(position,1.0));
      vec3 N3=normalize(vec3(itM*vec4(normal,1.0)));
  float c=dot(N3,normalize(u_light_pos-P3));
   v_col=vec3(0.0);
     if(c>0.0) v_col=c*materialColour;
  gl_Position=P*V*vec4(P3,1.0);
}
