// A small picture of a texture: each pixel the mean of a few lookups. The first row drawn is the top one.

#if CUBE
uniform samplerCube source;
#else
uniform sampler2D source;
#endif
uniform vec2 picture_size;  // pixels
uniform float level;        // of the texture
uniform bool signed_halves; // texels hold 2 t - 1
uniform bool encodes;       // texels are linear light
uniform bool opaque;        // alpha says nothing

out vec4 frag_color;

const int TAPS = 4; // along a pixel's side

// The texel at a place from (0, 0), top left, to (1, 1).
vec4 texel_at(vec2 place) {
#if CUBE
    // A cross:    +y
    //          -x +z +x -z
    //             -y        with s and t as OpenGL has them on each face.
    vec2 cell = place * vec2(4.0, 3.0);
    ivec2 which = ivec2(cell);
    vec2 st = 2.0 * fract(cell) - 1.0;
    if (which.y == 0) return which.x == 1 ? textureLod(source, vec3(st.x, 1.0, st.y), level) : vec4(0.0);
    if (which.y == 2) return which.x == 1 ? textureLod(source, vec3(st.x, -1.0, -st.y), level) : vec4(0.0);
    if (which.x == 0) return textureLod(source, vec3(-1.0, -st.y, st.x), level);
    if (which.x == 1) return textureLod(source, vec3(st.x, -st.y, 1.0), level);
    if (which.x == 2) return textureLod(source, vec3(1.0, -st.y, -st.x), level);
    return textureLod(source, vec3(-st.x, -st.y, -1.0), level);
#else
    return textureLod(source, vec2(place.x, 1.0 - place.y), level);
#endif
}

bool is_empty(vec2 place) {
#if CUBE
    ivec2 which = ivec2(place * vec2(4.0, 3.0));
    return which.y != 1 && which.x != 1;
#else
    return false;
#endif
}

// IEC 61966-2-1.
vec3 srgb(vec3 linear) {
    vec3 low = 12.92 * linear;
    vec3 high = 1.055 * pow(max(linear, vec3(0.0)), vec3(1.0 / 2.4)) - 0.055;
    return mix(high, low, vec3(lessThanEqual(linear, vec3(0.0031308))));
}

void main() {
    vec4 sum = vec4(0.0);
    for (int y = 0; y < TAPS; ++y) {
        for (int x = 0; x < TAPS; ++x) {
            vec2 inside = (vec2(x, y) + 0.5) / float(TAPS) - 0.5;
            // What is brighter than white would outweigh its neighbours.
            sum += clamp(texel_at((gl_FragCoord.xy + inside) / picture_size), -1.0, 1.0);
        }
    }
    vec4 texel = sum / float(TAPS * TAPS);
    if (signed_halves) texel = 0.5 * texel + 0.5;
    if (opaque) texel.a = 1.0;
    texel = clamp(texel, 0.0, 1.0);
    if (encodes) texel.rgb = srgb(texel.rgb);
    frag_color = is_empty(gl_FragCoord.xy / picture_size) ? vec4(0.0) : texel;
}
