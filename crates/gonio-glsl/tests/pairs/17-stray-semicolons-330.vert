#version 330 core
in vec3 position;;
struct A { float x; };
;
uniform A a;
void main() { gl_Position = vec4(position * a.x, 1.0);; };
