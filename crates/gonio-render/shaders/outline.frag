// The outline of a mask: a line outside its edge, two pixels wide.

uniform highp sampler2D linear_picture;   // the mask: 1 inside
uniform vec2 picture_size;                // pixels
uniform vec4 line_color;                  // display-encoded, not premultiplied

out vec4 frag_color;

// A circle of two pixels; its points are no further apart than a pixel, so that thin parts have an outline too.
const ivec2 CIRCLE[12] = ivec2[12](
    ivec2(2, 0), ivec2(2, 1), ivec2(1, 2), ivec2(0, 2), ivec2(-1, 2), ivec2(-2, 1),
    ivec2(-2, 0), ivec2(-2, -1), ivec2(-1, -2), ivec2(0, -2), ivec2(1, -2), ivec2(2, -1));
// Points of the circle inside the mask from which the line is opaque.
const float ENOUGH = 2.5;

void main() {
    ivec2 last = ivec2(picture_size) - 1;
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    pixel.y = last.y - pixel.y;   // the top row first
    frag_color = vec4(0.0);
    if (texelFetch(linear_picture, pixel, 0).r > 0.5) return;
    float inside = 0.0;
    for (int i = 0; i < 12; i++) {
        inside += step(0.5, texelFetch(linear_picture, clamp(pixel + CIRCLE[i], ivec2(0), last), 0).r);
    }
    float alpha = line_color.a * min(inside / ENOUGH, 1.0);
    frag_color = vec4(line_color.rgb * alpha, alpha);
}
