// Directions for an environment's light on a BRDF that is any function: twins of gonio-light's function_light.rs, in f32.
// Sources are listed there. Directions are in the local frame: tangent +X, bitangent +Y, normal +Z.
// From Rust: LEAST_VIEW_COSINE, LEVELS_BEYOND, GOLDEN_SECTION.
//
// A lobe is (alpha along the tangent, alpha along the bitangent, lean, 1 if it leans or else 0).

// A point of a spiral in the unit square.
vec2 spiral_point(int index, int count) {
    return vec2((float(index) + 0.5) / float(max(count, 1)), fract(float(index) * GOLDEN_SECTION));
}

// The view, not lower than LEAST_VIEW_COSINE.
vec3 raised_view(vec3 v) {
    if (v.z >= LEAST_VIEW_COSINE) return v;
    float across = length(v.xy);
    vec2 along = across > 1e-6 ? v.xy / across : vec2(1.0, 0.0);
    return vec3(sqrt(1.0 - LEAST_VIEW_COSINE * LEAST_VIEW_COSINE) * along, LEAST_VIEW_COSINE);
}

// The middle of a round lobe.
vec3 lobe_axis(vec4 lobe, vec3 v) {
    return normalize(vec3(-lobe.z * v.xy, v.z));
}

// A direction of the lobe, from two numbers in [0, 1).
vec3 lobe_direction(vec4 lobe, vec3 v, vec2 u) {
    bool leans = lobe.w > 0.5;
    vec3 seen = leans ? vec3(0.0, 0.0, 1.0) : v;
    vec3 stretched = normalize(vec3(lobe.xy * seen.xy, seen.z));
    float z = (1.0 - u.x) * (1.0 + stretched.z) - stretched.z;
    float phi = 2.0 * PI * u.y;
    vec3 h = vec3(sqrt(max(1.0 - z * z, 0.0)) * vec2(cos(phi), sin(phi)), z) + stretched;
    vec3 l = reflection(normalize(vec3(lobe.xy * h.xy, h.z)), seen);
    vec3 axis = lobe_axis(lobe, v);
    vec3 t = any_orthonormal_vector(axis);
    return leans ? l.x * t + l.y * cross(axis, t) + l.z * axis : l;
}

// The density of lobe_direction in 1/sr.
float lobe_density(vec4 lobe, vec3 v, vec3 l) {
    bool leans = lobe.w > 0.5;
    vec3 seen = leans ? vec3(0.0, 0.0, 1.0) : v;
    vec3 axis = lobe_axis(lobe, v);
    vec3 t = any_orthonormal_vector(axis);
    vec3 h = leans ? half_vector(l, axis, t) : half_vector(l, v, vec3(0.0, 0.0, 1.0));
    if (leans) h = vec3(dot(h, t), dot(h, cross(axis, t)), dot(h, axis));
    vec2 slope = h.xy / lobe.xy;
    float slopes = dot(slope, slope) + h.z * h.z;
    float stretched = length(vec3(lobe.xy * seen.xy, seen.z));
    // No facet faces down.
    return h.z > 0.0 ? 1.0 / (PI * lobe.x * lobe.y * slopes * slopes) / (2.0 * (seen.z + stretched)) : 0.0;
}

// A direction of the upper hemisphere with the density cos theta / pi.
vec3 cosine_direction(vec2 u) {
    float phi = 2.0 * PI * u.y;
    return vec3(sqrt(u.x) * vec2(cos(phi), sin(phi)), sqrt(1.0 - u.x));
}

// The level of a cubemap with `size` texels an edge for a lookup along the unit vector d over the solid angle w.
float lookup_level(float size, vec3 d, float w) {
    float m = max(max(abs(d.x), abs(d.y)), abs(d.z));
    return max(0.5 * log2(0.25 * w * size * size / (m * m * m)) + LEVELS_BEYOND, 0.0);
}
