#version 300 es
precision mediump float;
in vec3 v_tex;
uniform samplerCube skybox;
out vec4 FragColor;
// TODO clean
void main() { FragColor = texture(skybox, v_tex); }
