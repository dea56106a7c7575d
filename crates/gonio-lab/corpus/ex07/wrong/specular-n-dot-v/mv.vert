#version 440 core
in vec3 position;
in vec3 normal;
uniform mat4 MV;
uniform mat4 P;
out vec3 eyePos3;
out vec3 eyeNormal;
void main()
{
  vec4 e = MV * vec4(position, 1.0);
  eyePos3 = e.xyz;
  eyeNormal = normalize(mat3(transpose(inverse(MV))) * normal);
  gl_Position = P * e;
}
