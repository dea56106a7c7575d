// Each triangle has three vertices of its own, drawn in order, so the number of a vertex determines its corner.

in vec3 position;

uniform mat4 clip_from_model;

out vec3 v_corner;   // barycentric coordinates

void main() {
    gl_Position = clip_from_model * vec4(position, 1.0);
    int corner = gl_VertexID % 3;
    v_corner = vec3(corner == 0, corner == 1, corner == 2);
}
