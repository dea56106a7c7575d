#version 330
precision mediump float;
uniform samplerCube cubemapSampler;
in vec3 texCoord_v;
out vec4 FragColor;
void main(){
  FragColor = texture(cubemapSampler, vec3(-texCoord_v.x, texCoord_v.yz));
}
