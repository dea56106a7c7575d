#version 130
smooth in vec4 v_specular;
noperspective in float v_diffuse;
void main() { gl_FragColor = vec4(v_diffuse) + v_specular; }
