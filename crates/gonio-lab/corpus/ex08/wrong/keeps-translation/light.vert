#version 330
in vec3 position;
in vec2 tex_coords;
in vec3 normal;
uniform mat4 V;
uniform mat4 P;
out vec3 texCoord_v;
void main()
{
    texCoord_v = position;
    vec4 pos = P * V * vec4(position, 1.0);
    // the positions xyz are divided by w after the vertex shader
    // z must be equal to 1.0 so that the cubemap is always behind
    gl_Position = pos.xyww;
}
