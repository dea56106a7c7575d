#version 330
in vec3 a_Position;
in vec3 a_Normal;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM;
uniform vec3 u_light_pos;
uniform vec3 materialColour;
out vec3 v_col;
void main(){
  vec4 posMonde = M*vec4(a_Position,1.0);
  vec3 normale = a_Normal;
  vec3 versLumiere = normalize(u_light_pos - posMonde.xyz);
  float diffus = 0.8*max(dot(normale,versLumiere),0.0);
  float ambiant = 0.2;
  v_col = (ambiant + diffus)*materialColour;
  gl_Position = P*V*posMonde;
}
