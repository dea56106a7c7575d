#version 400 core
in vec3 v_col;
in vec2 v_tex;
in vec3 v_normal;
out vec4 FragColor;
uniform sampler2D tex0;
void main(){
  //FragColor=texture(tex0,v_tex);
  //FragColor=vec4(v_normal,1.0);
  FragColor=vec4(v_col,1.0);
}
