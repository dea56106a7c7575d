#version 330 core
in vec3 position;
uniform mat4 V;
uniform mat4 P;
out vec3 direction;
void main() {
  direction = position;
  vec3 vue = vec3(V * vec4(position, 0.0)); // w = 0 : une direction, pas un point
  vec4 clip = P * vec4(vue, 1.0);
  gl_Position = vec4(clip.xy, clip.w, clip.w); // profondeur 1 : derrière tout
}
