// The grid and the contact shadow on the ground: display-encoded, premultiplied.

in vec2 v_place;                     // world units from the middle

uniform vec2 origin;                 // a crossing of strong lines, at v_place - origin = 0
uniform vec2 world_axes;             // where the lines through the world's origin are
uniform float line_step;             // world units
uniform float strong_step;
uniform float reach;                 // where the grid has faded
uniform vec4 line_color;             // not premultiplied
uniform vec3 axis_colors[2];         // of the lines along the first and along the second axis
uniform highp sampler2D contact_map; // what the objects hide
uniform float contact_half;          // half its side, world units
uniform float contact_strength;

out vec4 frag_color;

// The share of the pixel that lines at 0 cover; lines closer than some pixels fade to their mean.
vec2 lines(vec2 place, vec2 pixel, float width) {
    vec2 pixels = abs(place) / pixel;
    return clamp(0.5 * width + 0.5 - pixels, 0.0, 1.0);
}

vec2 repeated(vec2 place, vec2 pixel, float line_distance, float width) {
    vec2 nearest = place - line_distance * round(place / line_distance);
    vec2 density = pixel / line_distance;
    return lines(nearest, pixel, width) * (1.0 - smoothstep(0.08, 0.35, density));
}

void main() {
    vec2 place = v_place - origin;
    vec2 pixel = vec2(length(vec2(dFdx(place.x), dFdy(place.x))), length(vec2(dFdx(place.y), dFdy(place.y))));
    pixel = max(pixel, vec2(1e-30));
    vec2 weak = 0.45 * repeated(place, pixel, line_step, 1.0);
    vec2 strong = repeated(place, pixel, strong_step, 1.3);
    vec2 both = max(weak, strong);
    vec2 axes = lines(v_place - world_axes, pixel, 1.8);
    float grid = max(both.x, both.y) * line_color.a;
    vec3 color = line_color.rgb;
    // A line at a constant second coordinate runs along the first axis.
    float along_first = axes.y;
    float along_second = axes.x;
    color = mix(color, axis_colors[1], along_second);
    color = mix(color, axis_colors[0], along_first);
    grid = max(grid, 0.62 * max(along_first, along_second));
    grid *= 1.0 - smoothstep(0.3 * reach, reach, length(v_place));

    vec2 at = 0.5 + 0.5 * v_place / contact_half;
    vec2 edge = min(at, 1.0 - at);
    float shade = textureLod(contact_map, at, 0.0).r * smoothstep(0.0, 0.12, min(edge.x, edge.y));
    shade *= contact_strength;

    frag_color = vec4(color * grid, grid + (1.0 - grid) * shade);
}
