// Eight by eight squares with lines between them for each unit of the texture coordinates. Red grows with u, green with
// v, so that mirrored and turned textures are visible; the square at the origin has a white mark that points along u.

in vec3 v_position_in_world;
in vec3 v_normal_in_world;
in vec2 v_tex_coord;

uniform vec3 eye_in_world;

out vec4 frag_color;

const float SQUARES = 8.0;

void main() {
    vec2 tile = fract(v_tex_coord);
    vec2 place = tile * SQUARES;
    vec2 square = floor(place);
    vec2 within = place - square;
    // If a pixel is as large as a square, it has the mean of two squares, which avoids moire.
    vec2 width = fwidth(v_tex_coord) * SQUARES;
    float seen = 1.0 - smoothstep(0.4, 1.2, max(width.x, width.y));
    float light = mod(square.x + square.y, 2.0);
    vec3 tint = vec3(0.25 + 0.65 * tile.x, 0.25 + 0.65 * tile.y, 0.55);
    vec3 color = tint * mix(0.75, mix(0.55, 0.95, light), seen);
    // Lines of about a pixel between squares, of two around the unit square.
    vec2 to_line = min(within, 1.0 - within) / max(width, vec2(1e-6));
    vec2 to_edge = min(place, SQUARES - place) / max(width, vec2(1e-6));
    float line = 1.0 - smoothstep(0.25, 0.9, min(to_line.x, to_line.y));
    float edge = 1.0 - smoothstep(0.8, 1.6, min(to_edge.x, to_edge.y));
    color = mix(color, vec3(0.08), 0.6 * line * seen);
    color = mix(color, vec3(0.02), edge * seen);
    // A triangle in the first square, its tip towards +u.
    vec2 mark = within - vec2(0.25, 0.5);
    if (square == vec2(0.0) && mark.x > 0.0 && mark.x < 0.5 && abs(mark.y) < 0.5 * (0.5 - mark.x)) {
        color = mix(color, vec3(1.0), seen);
    }
    // Some light from the eye, so that the form is visible.
    vec3 n = v_normal_in_world;
    vec3 v = eye_in_world - v_position_in_world;
    float cosine = abs(dot(n, v)) * inversesqrt(max(dot(n, n) * dot(v, v), 1e-30));
    frag_color = vec4(color * mix(0.55, 1.0, cosine), 1.0);
}
