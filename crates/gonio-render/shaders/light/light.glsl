// Attenuation and spot factor: twins of gonio-light's light.rs, in f32.
// From Rust: ATTENUATION_CAP.

// 1 / (k.x + k.y d + k.z d^2) for k = (constant, linear, quadratic), d in world units; in
// [0, ATTENUATION_CAP]. Horner's form, so that a coefficient of 0 stays 0 for every finite d; and d is
// finite: length() overflows beyond 1.8e19.
float attenuation_at(vec3 k, float d) {
    d = min(d, 1e30);
    float denominator = k.x + d * (k.y + k.z * d);
    return denominator > 1.0 / ATTENUATION_CAP ? 1.0 / denominator : ATTENUATION_CAP;
}

// smoothstep; if the edges are equal or in the wrong order, a step that is 1 at x = edge0.
float smoothstep_or_step(float edge0, float edge1, float x) {
    float width = edge1 - edge0;
    if (width > 0.0) {
        float t = clamp((x - edge0) / width, 0.0, 1.0);
        return t * t * (3.0 - 2.0 * t);
    }
    return x < edge0 ? 0.0 : 1.0;
}
