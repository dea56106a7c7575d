#version 330 core
precision mediump float;
uniform samplerCube cubemapSampler;
in vec3 texCoord_v;
out vec4 FragColor;
void main(){
    FragColor = texture(cubemapSampler, texCoord_v);
}
