#version 330
in vec3 aPos;
in vec2 tex_coords;
in vec3 aNormal;
uniform mat4 V;
uniform mat4 projection;
out vec3 texCoord_v;
void main(){
  texCoord_v = aPos;
  // remove translation info from the view matrix to only keep rotation
  mat4 V_no_rot = mat4(mat3(V));
  vec4 pos = projection * V_no_rot * vec4(aPos, 1.0);
  // the positions xyz are divided by w after the vertex shader
  // z must be equal to 1.0 so that the cubemap is always behind
  gl_Position = pos.xyww;
}
