#version 130
in vec3 position;
in vec3 normal;
in vec2 texcoord;
uniform mat4 M;
   uniform mat4 V;
uniform mat4 P;
      uniform mat4 itM;
out vec3 v_normal;
out vec3 v_frag_coord;
void main()
{
  vec4 w=M*vec4(position,1.0);
      v_frag_coord=w.xyz;
   v_normal=normalize((itM*vec4(normal,1.0)).xyz);
    gl_Position=P*V*w;
}
