#version 330 core
in vec2 v_tex;
in float distance;
uniform sampler2D texture;
out vec4 FragColor;
void main() { FragColor = texture(texture, v_tex) / distance; }
