#version 130
in vec3 a_Position;
in vec3 a_Normal;
in vec2 texcoord;
uniform mat4 M;
   uniform mat4 V;
uniform mat4 P;
      uniform mat4 itM;
out vec3 vNormal;
out vec3 vPos;
void main()
{
  vec4 w=M*vec4(a_Position,1.0);
      vPos=w.xyz;
   vNormal=normalize((itM*vec4(a_Normal,1.0)).xyz);
    gl_Position=P*V*w;
}
