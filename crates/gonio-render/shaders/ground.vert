// A square of the ground.

uniform mat4 clip_from_ground;   // of (x, y, 0, 1), x and y along its axes from the middle of the square
uniform float reach;             // half the square's side, world units

out vec2 v_place;

void main() {
    v_place = reach * vec2(gl_VertexID % 2 == 0 ? -1.0 : 1.0, gl_VertexID < 2 ? -1.0 : 1.0);
    gl_Position = clip_from_ground * vec4(v_place, 0.0, 1.0);
}
