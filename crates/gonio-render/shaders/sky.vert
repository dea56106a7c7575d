// The environment behind everything: one triangle over the whole picture at the far plane.

uniform mat3 environment_from_clip;   // of (x, y, 1), x and y from -1 to 1 over the picture

out vec3 v_direction;                 // in the environment, of any length

void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    gl_Position = vec4(corner, 1.0, 1.0);
    v_direction = environment_from_clip * vec3(corner, 1.0);
}
