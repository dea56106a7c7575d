#version 100
attribute vec3 position;
attribute vec3 normal;
uniform mat4 model, view, projection;
varying vec3 v_normal, v_pos;
void main() {
  vec4 world = model * vec4(position, 1.0);
  v_normal = mat3(model[0].xyz, model[1].xyz, model[2].xyz) * normal;
  v_pos = world.xyz;
  gl_Position = projection * view * world;
}
