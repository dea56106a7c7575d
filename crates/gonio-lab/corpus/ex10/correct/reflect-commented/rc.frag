#version 130
in vec3 v_normal;
in vec3 v_frag_coord;
uniform vec3 u_view_pos;
uniform float refractionIndice;
uniform float shininess;
uniform samplerCube cubemapSampler;
out vec4 FragColor;
void main()
{
   vec3 N=normalize(v_normal);
      vec3 V=normalize(u_view_pos-v_frag_coord);
   //vec3 R=reflect(-V,N);
   vec3 R=refract(-V,N,1.0/refractionIndice);
  FragColor=vec4(texture(cubemapSampler,R).rgb,1.0);
}
