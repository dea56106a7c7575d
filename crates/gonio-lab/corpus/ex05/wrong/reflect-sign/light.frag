#version 400 core
out vec4 FragColor;
precision mediump float;
in float v_diffuse;
in float v_specular;
uniform vec3 materialColour;
void main() {
    FragColor = vec4(materialColour * (v_diffuse + v_specular), 1.0);
}
