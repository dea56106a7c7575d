#version 130
in vec3 aPos;
in vec3 aNormal;
in vec2 texcoord;
uniform mat4 model;
   uniform mat4 view;
uniform mat4 projection;
    uniform mat4 itM;
out vec3 v_normal;
out vec3 v_frag_coord;
out vec2 v_t;
void main()
{
  vec4 w=model*vec4(aPos,1.0);
    v_frag_coord=w.xyz;
   v_normal=normalize((itM*vec4(aNormal,1.0)).xyz);
  v_t=vec2(texcoord.x,1.0-texcoord.y);
  gl_Position=projection*view*w;
}
