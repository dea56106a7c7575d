#version 130
in vec3 vNormal;
in vec3 vPos;
uniform vec3 u_view_pos;
uniform float refractionIndice;
uniform float shininess;
uniform samplerCube cubemapSampler;
out vec4 color_out;
void main()
{
   vec3 N=normalize(vNormal);
      vec3 V=normalize(-vPos);
   //vec3 R=reflect(-V,N);
   vec3 R=refract(-V,N,1.0/refractionIndice);
  color_out=vec4(texture(cubemapSampler,R).rgb,1.0);
}
