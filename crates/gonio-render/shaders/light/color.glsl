// Exposure, tone maps, sRGB: twins of gonio-light's color.rs, in f32.
// From Rust: RADIANCE_CAP, EXPOSURE_LIMIT.

// x clamped to [0, 1]; NaN becomes 0, for which clamp is undefined.
float unit_interval(float x) {
    return x > 0.0 ? min(x, 1.0) : 0.0;
}

vec3 unit_interval(vec3 c) {
    return mix(vec3(0.0), min(c, vec3(1.0)), greaterThan(c, vec3(0.0)));
}

// x clamped to [0, RADIANCE_CAP]; NaN becomes 0.
float capped(float x) {
    return x > 0.0 ? min(x, RADIANCE_CAP) : 0.0;
}

vec3 capped(vec3 c) {
    return mix(vec3(0.0), min(c, vec3(RADIANCE_CAP)), greaterThan(c, vec3(0.0)));
}

// linear * 2^stops
vec3 exposed(vec3 linear, float stops) {
    return capped(capped(linear) * exp2(clamp(stops, -EXPOSURE_LIMIT, EXPOSURE_LIMIT)));
}

// x / (1 + x) per channel
vec3 reinhard(vec3 linear) {
    return linear / (1.0 + linear);
}

// Narkowicz's fit of the ACES filmic curve; the caller clamps. The min keeps x^2 within f32.
vec3 aces(vec3 linear) {
    vec3 x = min(linear, vec3(100.0));
    return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
}

// Wrensch's polynomial of AgX's sigmoid over [0, 1]
vec3 agx_contrast(vec3 x) {
    return (((((15.5 * x - 40.14) * x + 31.96) * x - 6.868) * x + 0.4298) * x + 0.1191) * x - 0.00232;
}

// AgX's default look, decoded from its display of exponent 2.2 to linear light
vec3 agx(vec3 linear) {
    const mat3 working_from_srgb = mat3(
        0.842479062253094, 0.0423282422610123, 0.0423756549057051,
        0.0784335999999992, 0.878468636469772, 0.0784336,
        0.0792237451477643, 0.0791661274605434, 0.879142973793104);
    const mat3 srgb_from_working = mat3(
        1.19687900512017, -0.0528968517574562, -0.0529716355144438,
        -0.0980208811401368, 1.15190312990417, -0.0980434501171241,
        -0.0990297440797205, -0.0989611768448433, 1.15107367264116);
    const float min_ev = -12.47393;
    const float max_ev = 4.026069;
    // The logarithm of 0 is undefined; everything below 2^min_ev is the same black.
    vec3 stops = clamp(log2(max(working_from_srgb * linear, vec3(1e-10))), min_ev, max_ev);
    vec3 display = srgb_from_working * agx_contrast((stops - min_ev) / (max_ev - min_ev));
    return pow(unit_interval(display), vec3(2.2));
}

// The sRGB transfer function (IEC 61966-2-1); light outside of [0, 1] is clamped.
float srgb_encode(float linear) {
    float x = unit_interval(linear);
    return x <= 0.0031308 ? x * 12.92 : 1.055 * pow(x, 1.0 / 2.4) - 0.055;
}

vec3 srgb_encode(vec3 linear) {
    vec3 x = unit_interval(linear);
    return mix(1.055 * pow(x, vec3(1.0 / 2.4)) - 0.055, x * 12.92, lessThanEqual(x, vec3(0.0031308)));
}

// Its inverse.
float srgb_decode(float encoded) {
    float x = unit_interval(encoded);
    return x <= 0.04045 ? x / 12.92 : pow((x + 0.055) / 1.055, 2.4);
}

vec3 srgb_decode(vec3 encoded) {
    vec3 x = unit_interval(encoded);
    return mix(pow((x + 0.055) / 1.055, vec3(2.4)), x / 12.92, lessThanEqual(x, vec3(0.04045)));
}
