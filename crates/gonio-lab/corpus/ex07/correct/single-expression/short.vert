#version 330 core
in vec3 position, normal;
uniform mat4 M, V, P, itM;
out vec3 p, n;
void main() { gl_Position = P*V*vec4(p = (M*vec4(position,1)).xyz, 1); n = normalize((itM*vec4(normal,0)).xyz); }
