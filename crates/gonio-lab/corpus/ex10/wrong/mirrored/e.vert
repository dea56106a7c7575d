#version 300 es
in vec3 aPos;
in vec3 aNormal;
uniform mat4 model;
uniform mat4 view;
uniform mat4 projection;
uniform mat4 itM;
out vec3 v_normal;
out vec3 v_pos;
void main() {
  vec4 w = model * vec4(aPos, 1.0);
  v_pos = w.xyz;
  v_normal = normalize(mat3(itM) * aNormal);
  gl_Position = projection * view * w;
}
