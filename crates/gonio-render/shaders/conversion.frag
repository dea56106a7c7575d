// A pixel of a panorama or of a cubemap's face, looked up in another: the twin of gonio-environment's convert.

uniform highp sampler2DArray source;   // rows from the top; faces with SOURCE_BORDER texels of their neighbours around
uniform ivec2 source_size;             // of a panorama, or of a face without its border
uniform ivec2 target_size;
uniform mat3 source_from_target;
uniform vec3 face_middle;              // of the target's face
uniform vec3 face_along_s;
uniform vec3 face_along_t;

out vec4 frag_color;

// atan(y, x) to 3e-7, alike on every driver.
float angle(float y, float x) {
    float across = abs(y);
    float along = abs(x);
    float ratio = min(across, along) / max(max(across, along), 1e-37);
    float square = ratio * ratio;
    float sum = ARC_TANGENT_POLYNOMIAL;
    float first_eighth = ratio * sum;
    float first_quarter = across > along ? 0.5 * PI - first_eighth : first_eighth;
    float half_turn = x < 0.0 ? PI - first_quarter : first_quarter;
    return y < 0.0 ? -half_turn : half_turn;
}

// The direction of a place: pixels from the middle of the first one, rows downwards.
vec3 direction(vec2 place) {
#if TO_CUBEMAP
    vec2 st = (place + 0.5) * (2.0 / float(target_size.x)) - 1.0;
    vec3 d = face_middle + st.x * face_along_s + st.y * face_along_t;
#else
    float longitude = (place.x + 0.5 - 0.5 * float(target_size.x)) * (2.0 * PI / float(target_size.x));
    float polar = (place.y + 0.5) * (PI / float(target_size.y));
    vec3 d = vec3(sin(polar) * sin(longitude), cos(polar), -sin(polar) * cos(longitude));
#endif
    return source_from_target * d;
}

// The place of a direction in the source: x and y in texels from the middle of the first one, and the layer.
vec3 source_place(vec3 d) {
#if FROM_CUBEMAP
    vec3 a = abs(d);
    float layer;
    vec2 st;
    float largest;
    if (a.x >= a.y && a.x >= a.z) {
        layer = d.x < 0.0 ? 1.0 : 0.0;
        st = vec2(d.x < 0.0 ? d.z : -d.z, -d.y);
        largest = a.x;
    } else if (a.y >= a.z) {
        layer = d.y < 0.0 ? 3.0 : 2.0;
        st = vec2(d.x, d.y < 0.0 ? -d.z : d.z);
        largest = a.y;
    } else {
        layer = d.z < 0.0 ? 5.0 : 4.0;
        st = vec2(d.z < 0.0 ? -d.x : d.x, -d.y);
        largest = a.z;
    }
    float size = float(source_size.x);
    vec2 place = st * (0.5 * size / max(largest, 1e-37)) + (0.5 * size - 0.5);
    return vec3(clamp(place, vec2(-0.5), vec2(size - 0.5)), layer);
#else
    float longitude = angle(d.x, -d.z);
    float latitude = angle(d.y, length(d.xz));
    vec2 size = vec2(source_size);
    return vec3(longitude * (size.x / (2.0 * PI)) + (0.5 * size.x - 0.5), -latitude * (size.y / PI) + (0.5 * size.y - 0.5), 0.0);
#endif
}

vec4 source_texel(ivec2 at, int layer) {
#if FROM_CUBEMAP
    return texelFetch(source, ivec3(at + SOURCE_BORDER, layer), 0);
#else
    // Beyond a pole the same row continues half a turn further.
    if (at.y < 0) {
        at = ivec2(at.x + source_size.x / 2, min(-1 - at.y, source_size.y - 1));
    } else if (at.y >= source_size.y) {
        at = ivec2(at.x + source_size.x / 2, max(2 * source_size.y - 1 - at.y, 0));
    }
    // % is undefined for negative numbers; no filter reaches as far as four widths.
    int x = (at.x + 4 * source_size.x) % source_size.x;
    return texelFetch(source, ivec3(x, at.y, layer), 0);
#endif
}

vec4 bilinear(vec3 d) {
    vec3 place = source_place(d);
    vec2 corner = floor(place.xy);
    vec2 share = place.xy - corner;
    ivec2 at = ivec2(corner);
    int layer = int(place.z);
    vec4 upper = mix(source_texel(at, layer), source_texel(at + ivec2(1, 0), layer), share.x);
    vec4 lower = mix(source_texel(at + ivec2(0, 1), layer), source_texel(at + ivec2(1, 1), layer), share.x);
    return mix(upper, lower, share.y);
}

#if FILTER == FILTER_NEAREST
vec4 nearest(vec3 d) {
    vec3 place = source_place(d);
    return source_texel(ivec2(floor(place.xy + 0.5)), int(place.z));
}
#elif FILTER == FILTER_BICUBIC
vec4 catmull_rom(float t) {
    float t2 = t * t;
    float t3 = t2 * t;
    return 0.5 * vec4(-t3 + 2.0 * t2 - t, 3.0 * t3 - 5.0 * t2 + 2.0, -3.0 * t3 + 4.0 * t2 + t, t3 - t2);
}

vec4 bicubic(vec3 d) {
    vec3 place = source_place(d);
    vec2 corner = floor(place.xy);
    vec4 along = catmull_rom(place.x - corner.x);
    vec4 down = catmull_rom(place.y - corner.y);
    int layer = int(place.z);
    vec4 sum = vec4(0.0);
    for (int row = 0; row < 4; ++row) {
        ivec2 at = ivec2(corner) + ivec2(-1, row - 1);
        vec4 line = source_texel(at, layer) * along.x + source_texel(at + ivec2(1, 0), layer) * along.y
            + source_texel(at + ivec2(2, 0), layer) * along.z + source_texel(at + ivec2(3, 0), layer) * along.w;
        sum += line * down[row];
    }
    return max(sum, 0.0);
}
#elif FILTER == FILTER_AREA
// The distance in radians of neighbouring texels around a unit direction.
float spacing(vec3 d) {
#if FROM_CUBEMAP
    float m = max(max(abs(d.x), abs(d.y)), abs(d.z));
    return m * m * (2.0 / float(source_size.x));
#else
    float crowd = float(source_size.x) / (2.0 * float(source_size.y)) / max(length(d.xz), 1e-6);
    return PI / float(source_size.y) / (crowd < CROWDED ? max(crowd, 1.0) : 1.0);
#endif
}

float lookups_at(vec2 place) {
    float wide = distance(normalize(direction(place - vec2(0.5, 0.0))), normalize(direction(place + vec2(0.5, 0.0))));
    float high = distance(normalize(direction(place - vec2(0.0, 0.5))), normalize(direction(place + vec2(0.0, 0.5))));
    return max(wide, high) / spacing(normalize(direction(place)));
}

vec4 area(vec2 place) {
    // Groups of eight pixels use the largest k among them, as on the CPU.
    float most = 1.0;
    float first = 8.0 * floor(place.x / 8.0);
    for (int i = 0; i < 8; ++i) {
        most = max(most, lookups_at(vec2(first + float(i), place.y)));
    }
    int k = int(clamp(ceil(most - 1e-3), 1.0, float(MOST_ALONG)));
    float step = 1.0 / float(k);
    vec4 sum = vec4(0.0);
    for (int j = 0; j < k; ++j) {
        for (int i = 0; i < k; ++i) {
            sum += bilinear(direction(place + (vec2(float(i), float(j)) + 0.5) * step - 0.5));
        }
    }
    return sum * (step * step);
}
#endif

void main() {
    // The first row that is drawn is the top of the picture.
    vec2 place = floor(gl_FragCoord.xy);
#if FILTER == FILTER_NEAREST
    frag_color = nearest(direction(place));
#elif FILTER == FILTER_BILINEAR
    frag_color = bilinear(direction(place));
#elif FILTER == FILTER_BICUBIC
    frag_color = bicubic(direction(place));
#else
    frag_color = area(place);
#endif
}
