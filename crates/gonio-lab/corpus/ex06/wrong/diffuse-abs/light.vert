#version 460 core
layout(location=0) in vec3 position;
layout(location=1) in vec3 normal;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM;
out vec3 fragCoord;
out vec3 v_normal;


void main(){
  gl_Position = P * V * M * vec4(position, 1.0);
  fragCoord = (M * vec4(position, 1.0)).xyz;
  v_normal = normalize((itM * vec4(normal, 0.0)).xyz);
}
