// The outline of a mask: a line outside its edge.

uniform highp sampler2D linear_picture;   // the mask: 1 inside
uniform vec2 picture_size;                // pixels
uniform vec4 line_color;                  // display-encoded, not premultiplied

out vec4 frag_color;

const int REACH = 3;        // texels
const float WIDTH = 2.2;    // pixels

void main() {
    ivec2 last = ivec2(picture_size) - 1;
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    pixel.y = last.y - pixel.y;   // the top row first
    float nearest = float(REACH + 1);
    for (int y = -REACH; y <= REACH; y++) {
        for (int x = -REACH; x <= REACH; x++) {
            ivec2 at = clamp(pixel + ivec2(x, y), ivec2(0), last);
            if (texelFetch(linear_picture, at, 0).r > 0.5) {
                nearest = min(nearest, length(vec2(x, y)));
            }
        }
    }
    float inside = step(nearest, 0.5);
    float alpha = line_color.a * clamp(WIDTH + 0.5 - nearest, 0.0, 1.0) * (1.0 - inside);
    frag_color = vec4(line_color.rgb * alpha, alpha);
}
