#version 330
in vec3 v_col;
out vec4 color_out;
void main(){
  color_out = vec4(v_col,1.0);
}
