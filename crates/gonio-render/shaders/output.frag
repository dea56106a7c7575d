// From linear light to the values of the picture: the twin of gonio-scene's display.rs. The shader encodes sRGB, because
// sRGB framebuffers differ between platforms.

#if MULTISAMPLED
uniform highp sampler2DMS linear_picture; // premultiplied alpha
uniform int sample_count;
#else
uniform highp sampler2D linear_picture;   // premultiplied alpha
#if GRID
uniform int grid_side;                    // texels along a pixel's side
#endif
#endif
uniform vec2 picture_size;                // pixels
uniform bool top_row_first;               // for reading back into files
uniform int first_row;                    // of the picture, from its bottom, that linear_picture holds
uniform vec3 background_top;
uniform vec3 background_bottom;
uniform float background_alpha;           // 0 for a transparent background
#if DISPLAY == DISPLAY_AFFINE
uniform vec3 display_scale;
uniform vec3 display_bias;
#elif DISPLAY == DISPLAY_LIGHT
uniform float exposure;                   // stops
uniform float premultiply;                // 1: colours times their alpha
#endif

out vec4 frag_color;

// The pixel's light: the mean of its samples.
vec4 linear_at(ivec2 pixel) {
#if MULTISAMPLED
    vec4 sum = vec4(0.0);
    for (int i = 0; i < sample_count; ++i) sum += texelFetch(linear_picture, pixel, i);
    return sum / float(sample_count);
#elif GRID
    vec4 sum = vec4(0.0);
    for (int y = 0; y < grid_side; ++y) {
        for (int x = 0; x < grid_side; ++x) sum += texelFetch(linear_picture, pixel * grid_side + ivec2(x, y), 0);
    }
    return sum / float(grid_side * grid_side);
#else
    return texelFetch(linear_picture, pixel, 0);
#endif
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    if (top_row_first) pixel.y = int(picture_size.y) - 1 - pixel.y;
    vec4 texel = linear_at(ivec2(pixel.x, pixel.y - first_row));
#if DISPLAY == DISPLAY_LINEAR
    frag_color = texel;
#elif DISPLAY == DISPLAY_AFFINE
    // A vector or scalar: opaque, black where there is no object.
    vec3 value = texel.a > 0.0 ? texel.rgb / texel.a : vec3(0.0);
    vec3 shown = texel.a > 0.0 ? clamp(display_scale * value + display_bias, 0.0, 1.0) * min(texel.a, 1.0) : vec3(0.0);
    frag_color = vec4(shown, 1.0);
#else
    float y = (float(pixel.y) + 0.5) / picture_size.y;
    vec3 background = mix(background_bottom, background_top, y);
    texel += (1.0 - texel.a) * background_alpha * vec4(background, 1.0);
    vec3 value = texel.a > 0.0 ? texel.rgb / texel.a : vec3(0.0);
    float alpha = min(texel.a, 1.0);
    frag_color = vec4(display_light(value, exposure) * mix(1.0, alpha, premultiply), alpha);
#endif
}
