// The share of a light that reaches a point, from shadow maps: depths seen from the lights, all in one texture.
//
// Four texels around the point are compared with the plane of the surface that is lit, continued to the texel, so that a
// surface does not shadow itself however obliquely it is lit; their answers are interpolated.

uniform highp sampler2D shadow_atlas;
uniform highp sampler2D shadow_table;   // a map in each row, SHADOW_TEXELS texels: `row` in shadow_map.rs
#if !VERTEX_LIT
uniform bool closed_receiver;           // only fronts are seen, and behind them is the inside
#endif

// The geometric normal where light is summed; set before light_visibility is called.
vec3 receiver_normal;

// The largest share of a texel's width that a plane may rise to the next texel: beyond, it is seen from its edge.
const float STEEPEST = 100.0;

// The side of a cube: +X, -X, +Y, -Y, +Z, -Z.
int cube_side(vec3 d) {
    vec3 a = abs(d);
    if (a.x >= a.y && a.x >= a.z) return d.x >= 0.0 ? 0 : 1;
    if (a.y >= a.z) return d.y >= 0.0 ? 2 : 3;
    return d.z >= 0.0 ? 4 : 5;
}

// The distance along the light's direction in which the plane of the receiver is seen at e, from the point's own.
float plane_distance(vec3 p, vec3 n, vec2 e, float perspective, float texel) {
    float slope = dot(n.xy, e);
    float above = dot(n, p) - (1.0 - perspective) * slope;
    float below = n.z + perspective * slope;
    // From the edge, or beyond the horizon.
    if (abs(below) <= 1e-6 || (perspective > 0.5 && above * below <= 0.0)) return p.z - STEEPEST * texel;
    return clamp(above / below, p.z - STEEPEST * texel, p.z + STEEPEST * texel);
}

float light_visibility(int light, vec3 position, vec3 l) {
    int maps = int(light_texel(light, 1).w);
    if (maps == 0) return 1.0;
#if !VERTEX_LIT
    if (closed_receiver && dot(receiver_normal, l) <= 0.0) return 0.0;
#endif
    int map = int(light_texel(light, 0).w);
    if (maps > 1) map += cube_side(position - light_texel(light, 0).xyz);
    vec4 right_and_scale = texelFetch(shadow_table, ivec2(0, map), 0);
    vec4 up_and_scale = texelFetch(shadow_table, ivec2(1, map), 0);
    vec4 front_and_kind = texelFetch(shadow_table, ivec2(2, map), 0);
    vec4 origin_and_bias = texelFetch(shadow_table, ivec2(3, map), 0);
    vec4 offset_and_range = texelFetch(shadow_table, ivec2(4, map), 0);
    vec4 texels = texelFetch(shadow_table, ivec2(5, map), 0);
    if (texels.z < texels.x) return 1.0;   // nothing that is seen is lit through this side
    mat3 map_from_world = transpose(mat3(right_and_scale.xyz, up_and_scale.xyz, front_and_kind.xyz));
    vec3 p = map_from_world * (position - origin_and_bias.xyz);
    vec3 n = map_from_world * receiver_normal;
    vec2 scale = vec2(right_and_scale.w, up_and_scale.w);
    float perspective = front_and_kind.w;
    float near = offset_and_range.z;
    float far = offset_and_range.w;
    if (perspective > 0.5) p.z = max(p.z, near);
    float away = mix(1.0, p.z, perspective);
    float texel = away / min(scale.x, scale.y);
    // A texel and a half for the edges where two surfaces meet, and the rounding of depths of 24 bits.
    float rounding = 4e-7 * (perspective > 0.5 ? p.z * p.z / near : far - near);
    float bias = SHADOW_BIAS_TEXELS * texel + origin_and_bias.w + rounding;
    vec2 at = clamp(p.xy / away * scale + offset_and_range.xy, texels.xy, texels.zw + 1.0);
    vec2 first = floor(at - 0.5);
    vec2 weight = at - 0.5 - first;
    float lit[4];
    for (int i = 0; i < 4; ++i) {
        vec2 place = clamp(first + vec2(i & 1, i >> 1), texels.xy, texels.zw);
        float depth = texelFetch(shadow_atlas, ivec2(place), 0).r;
        float blocker = perspective > 0.5 ? near * far / (far - depth * (far - near)) : mix(near, far, depth);
        vec2 e = (place + 0.5 - offset_and_range.xy) / scale;
        float receiver = min(plane_distance(p, n, e, perspective, texel), p.z);
        lit[i] = blocker + bias >= receiver ? 1.0 : 0.0;
    }
    return mix(mix(lit[0], lit[1], weight.x), mix(lit[2], lit[3], weight.x), weight.y);
}
