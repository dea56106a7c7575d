#version 330 core
in vec3 position;
in vec2 tex_coords;
in vec3 normal;
uniform mat4 V;
uniform mat4 P;
out vec3 texCoord_v;
void main(){
    texCoord_v = position;
    // remove translation info from the view matrix to only keep rotation
    mat4 V_no_rot = mat4(mat3(V));
    vec4 pos = P * V_no_rot * vec4(position, 1.0);
    // the positions xyz are divided by w after the vertex shader
    // z must be equal to 1.0 so that the cubemap is always behind
    gl_Position = pos.xyww;
}
