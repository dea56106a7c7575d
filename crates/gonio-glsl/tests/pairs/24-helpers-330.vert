#version 330 core
in vec3 position; in vec3 normal; in vec2 texcoord;
uniform mat4 model; uniform mat4 view; uniform mat4 projection;
out vec3 FragPos; out vec3 Normal; out vec2 uv;
vec3 toWorld(in vec3 p);
void rotate(inout vec2 p, float a) { float s = sin(a), c = cos(a); p = vec2(c * p.x - s * p.y, s * p.x + c * p.y); }
void both(out vec3 a, out vec3 b) { a = position; b = normal; }
void main() {
  vec3 p, n; both(p, n);
  vec2 q = texcoord; rotate(q, 3);
  uv = q; FragPos = toWorld(p); Normal = mat3(transpose(inverse(model))) * n;
  gl_Position = projection * view * vec4(FragPos, 1.0);
}
vec3 toWorld(in vec3 p) { return (model * vec4(p, 1)).xyz; }
