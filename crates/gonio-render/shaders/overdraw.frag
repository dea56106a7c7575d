// The number of fragments shaded at a pixel as a colour; the last colour of the scale is for all larger numbers.

uniform highp sampler2D linear_picture;   // counts
uniform vec2 picture_size;                // pixels

out vec4 frag_color;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    pixel.y = int(picture_size.y) - 1 - pixel.y;   // the top row first
    float count = texelFetch(linear_picture, pixel, 0).r;
    frag_color = vec4(OVERDRAW_SCALE[int(clamp(count + 0.5, 0.0, float(OVERDRAW_STEPS - 1)))], 1.0);
}
