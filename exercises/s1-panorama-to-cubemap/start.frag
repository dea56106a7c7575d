#version 330 core
// Supplementary exercise: panorama to cubemap. So far, all six faces show the same part of the panorama.

in vec2 v_face_coord; // (s, t): columns to the right, rows downwards, each from -1 to 1

uniform sampler2D panorama; // first row first: its top row, +Y, is at v = 0
uniform int face;           // 0 to 5: +X, -X, +Y, -Y, +Z, -Z

out vec4 FragColor;

const float PI = 3.14159265358979;

// The direction in the world of a point on a face.
vec3 direction_of(int face, vec2 st) {
    // TODO: one case per face, following the table in the text.
    return vec3(st, -1.0);
}

// The point of the panorama that shows a unit direction; both coordinates are from 0 to 1.
vec2 place_in_panorama(vec3 direction) {
    // TODO: longitude and latitude, and from them the column and the row.
    return 0.5 + 0.25 * direction.xy;
}

void main() {
    vec3 direction = normalize(direction_of(face, v_face_coord));
    FragColor = vec4(texture(panorama, place_in_panorama(direction)).rgb, 1.0);
}
