#version 330 core
in vec3 position;
in vec3 normal;
uniform mat4 M, V, P, itM;
out vec3 pw, nw;
void main() { pw = (M*vec4(position,1.0)).xyz; nw = normalize(mat3(itM)*normal); gl_Position = P*V*vec4(pw,1.0); }
