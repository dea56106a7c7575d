#version 330 core
in vec3 position;
in vec3 normal;
uniform mat4 M;
uniform mat4 V;
uniform mat4 P;
uniform mat4 itM;
out vec4 v_world;
out vec4 v_norm4;
// ------------
void main() {
  v_world = M * vec4(position, 1.0);
  v_norm4 = vec4(normalize(vec3(itM * vec4(normal, 0.0))), 0.0);
  gl_Position = P * V * v_world;
}
