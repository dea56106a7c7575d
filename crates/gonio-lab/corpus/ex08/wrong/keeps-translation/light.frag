#version 330
precision mediump float;
uniform samplerCube cubemapSampler;
in vec3 texCoord_v;
out vec4 outColor;
void main()
{
    outColor = texture(cubemapSampler, texCoord_v);
}
