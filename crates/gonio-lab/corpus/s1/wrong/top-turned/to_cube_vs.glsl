#version 300 es
in vec3 a_position;
out vec2 v_st;
void main() {
    v_st = a_position.xy;
    gl_Position = vec4(a_position.xy, 0.0, 1.0);
}
