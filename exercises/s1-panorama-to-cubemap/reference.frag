#version 330 core
// Supplementary exercise: panorama to cubemap

in vec2 v_face_coord; // (s, t): columns to the right, rows downwards, each from -1 to 1

uniform sampler2D panorama; // first row first: its top row, +Y, is at v = 0
uniform int face;           // 0 to 5: +X, -X, +Y, -Y, +Z, -Z

out vec4 FragColor;

const float PI = 3.14159265358979;

// The direction in the world of a point on a face: the inverse of the specification's table.
vec3 direction_of(int face, vec2 st) {
    if (face == 0) return vec3(1.0, -st.y, -st.x);
    if (face == 1) return vec3(-1.0, -st.y, st.x);
    if (face == 2) return vec3(st.x, 1.0, st.y);
    if (face == 3) return vec3(st.x, -1.0, -st.y);
    if (face == 4) return vec3(st.x, -st.y, 1.0);
    return vec3(-st.x, -st.y, -1.0);
}

// The point of the panorama that shows a unit direction; both coordinates are from 0 to 1.
vec2 place_in_panorama(vec3 direction) {
    float longitude = atan(direction.x, -direction.z); // 0 is straight ahead, -Z; to the right is +X
    float latitude = asin(clamp(direction.y, -1.0, 1.0));
    return vec2(0.5 + longitude / (2.0 * PI), 0.5 - latitude / PI);
}

void main() {
    vec3 direction = normalize(direction_of(face, v_face_coord));
    FragColor = vec4(texture(panorama, place_in_panorama(direction)).rgb, 1.0);
}
