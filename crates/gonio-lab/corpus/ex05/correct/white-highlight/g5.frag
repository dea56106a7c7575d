#version 400
in vec3 v_diffuse;
in vec3 v_specular;
out vec4 FragColor;
void main() {
  FragColor = vec4(v_diffuse + v_specular, 1.0);
}
