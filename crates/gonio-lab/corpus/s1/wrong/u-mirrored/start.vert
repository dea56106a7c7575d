#version 330 core
// Supplementary exercise: panorama to cubemap. Nothing to do here: one square that covers the face.

in vec3 position; // a corner of the square, x and y each -1 or 1

out vec2 v_face_coord; // (s, t): columns to the right, rows downwards, each from -1 to 1

void main() {
    v_face_coord = position.xy;
    gl_Position = vec4(position.xy, 0.0, 1.0);
}
