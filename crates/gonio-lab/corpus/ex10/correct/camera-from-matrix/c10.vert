#version 330 core
in vec3 position, normal;
uniform mat4 M, V, P, itM;
out vec3 p, n;
void main() { p = (M*vec4(position,1)).xyz; n = normalize(mat3(itM)*normal); gl_Position = P*V*vec4(p,1); }
