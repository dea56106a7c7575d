#version 330 core
in vec3 p, n;
out vec4 o;
uniform struct Light { vec3 light_pos; float ambient_strength, diffuse_strength, specular_strength, constant, linear, quadratic; } light;
uniform vec3 u_view_pos, materialColour;
void main() {
  vec3 N=normalize(n),l=light.light_pos-p,L=normalize(l); float d=length(l);
  o = vec4(materialColour*(light.ambient_strength+(light.diffuse_strength*max(dot(N,L),0)+light.specular_strength*pow(max(dot(reflect(-L,N),normalize(u_view_pos-p)),0),32))/(light.constant+light.linear*d+light.quadratic*d*d)),1);
}
