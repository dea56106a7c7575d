#version 330 core
in vec3 position;
flat out int side;
centroid out vec3 c;
invariant gl_Position;
void main() { side = position.x > 0 ? 1 : -1; c = position; gl_Position = vec4(position, 1); }
