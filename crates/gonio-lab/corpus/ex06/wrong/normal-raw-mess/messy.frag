#version 330 core
in vec3 v_n;
in vec3 v_world;
uniform vec3 u_light_pos; uniform vec3 u_view_pos; uniform float shininess; uniform vec3 materialColour;
out vec4 FragColor;


void main()
{
   vec3 N=v_n/length(v_n);
  vec3 L=u_light_pos-v_world; L=L/length(L);
      vec3 V=u_view_pos-v_world; V=V/length(V);
  vec3 R=2.0*N*dot(N,L)-L;
     R=R/length(R);
  float d=dot(N,L); if(d<0.0)
{d=0.0;}
    float s=dot(R,V); if(s<0.0)
{s=0.0;}
  s=pow(s,shininess);

  FragColor=vec4(d*materialColour+s*materialColour,1.0);
}
