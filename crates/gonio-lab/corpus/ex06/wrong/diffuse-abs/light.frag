#version 460 core
struct Light { vec3 light_pos; float diffuse_strength; };
#define N 1
in vec3 fragCoord;
in vec3 v_normal;
uniform vec3 u_light_pos;
uniform vec3 camPos;
uniform vec3 materialColour;
out vec4 frag_color;


void main(){
  Light lights[N];
  lights[0].light_pos = u_light_pos;
  lights[0].diffuse_strength = 1.0;
  vec3 n = normalize(v_normal);
  vec3 v = normalize(camPos - fragCoord);
  vec3 sum = vec3(0);
  for(int k = 0; k < N; k++){
  vec3 l = normalize(lights[k].light_pos - fragCoord);
  sum += materialColour * lights[k].diffuse_strength * abs(dot(n, l));
  sum += materialColour * pow(max(dot(reflect(-l, n), v), 0.0), 32.0);
  }
  frag_color = vec4(sum, 1.0);
}
