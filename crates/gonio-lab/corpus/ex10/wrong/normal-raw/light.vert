#version 440 core
layout(location = 0) in vec3 aPos;
layout(location = 1) in vec2 aTexCoords;
layout(location = 2) in vec3 aNormal;
uniform mat4 M; uniform mat4 V; uniform mat4 P; uniform mat4 itM;
out Glass { vec3 position; vec3 normal; } o;
void main()
{
  o.position = (M * vec4(aPos, 1.0)).xyz;
  o.normal = aNormal;
  gl_Position = P * V * M * vec4(aPos, 1.0);
}
