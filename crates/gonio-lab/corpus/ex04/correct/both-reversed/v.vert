#version 330 core
in vec3 position, normal;
uniform mat4 M, V, P, itM;
out vec3 p3, n3;
void main() { p3 = (M*vec4(position,1)).xyz; n3 = normalize(mat3(itM)*normal); gl_Position = P*V*vec4(p3,1); }
