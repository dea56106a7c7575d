#version 330
in vec3 position;
out vec2 st;
void main() {
    st = position.xy;
    gl_Position = vec4(position, 1.0);
}
