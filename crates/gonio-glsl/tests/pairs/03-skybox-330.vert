#version 330 core
layout(location=0) in vec3 position;
uniform mat4 V;
uniform mat4 P;
out vec3 texCoord_v;
void main(){
    texCoord_v = position;
    //remove translation info from view matrix to only keep rotation
    mat4 V_no_rot = mat4(mat3(V)) ;
    vec4 pos = P * V_no_rot * vec4(position, 1.0);
    // the positions xyz are divided by w
    gl_Position = pos.xyww;
    gl_Position.z = gl_Position.w*0.9999;
}
