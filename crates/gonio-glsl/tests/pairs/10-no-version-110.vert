attribute vec3 position;
attribute vec2 tex_coord;
uniform mat4 MVP;
varying vec2 v_t;
void main() { v_t = tex_coord; gl_Position = MVP * vec4(position, 1); }
