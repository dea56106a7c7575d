#version 130
in vec3 v_normal;
in vec3 v_frag_coord;
in vec2 v_t;
struct Light{
  vec3 light_pos;
  float ambient_strength;
};
uniform Light light;
uniform float shininess;
uniform vec3 u_view_pos;
uniform samplerCube cubemapSampler;
out vec4 FragColor;
void main()
{
   vec3 N=normalize(v_normal);
      vec3 V=normalize(u_view_pos-v_frag_coord);
  //vec3 L=normalize(light.light_pos-v_frag_coord);
  //float specular=pow(max(dot(reflect(-L,N),V),0.0),shininess);
   vec3 R=reflect(-V,N);
  FragColor=vec4(texture(cubemapSampler,R).rgb,1.0);
}
