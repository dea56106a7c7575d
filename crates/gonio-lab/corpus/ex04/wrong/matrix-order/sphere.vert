#version 330 core
in vec3 position;
in vec3 normal;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM;
out vec3 v_n;
out vec3 v_pos;
void main() {
  v_n = normalize(vec3(itM * vec4(normal, 0.0)));
  v_pos = vec3(M * vec4(position, 1.0));
  gl_Position = P * M * V * vec4(position, 1.0);
}
