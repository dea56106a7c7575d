// The reflectance of a boundary of two media: twins of gonio-light's optics.rs, in f32.
// eta = eta_L / eta_T: the index on the side of the light divided by the other one.

// Exact, for unpolarised light and dielectrics; in [0, 1], 1 for total reflection.
float fresnel_dielectric(float cos_i, float eta) {
    if (eta == 1.0) return 0.0;
    float c = clamp(cos_i, 0.0, 1.0);
    float cos2_t = 1.0 - eta * eta * (1.0 - c * c);
    // Comparisons are false for NaN, so that it reaches the 1 below.
    if (eta > 0.0 && cos2_t >= 0.0) {
        float cos_t = sqrt(cos2_t);
        float s_sum = eta * c + cos_t;
        float p_sum = c + eta * cos_t;
        if (s_sum > 0.0 && p_sum > 0.0) {
            float r_s = (eta * c - cos_t) / s_sum;
            float r_p = (c - eta * cos_t) / p_sum;
            return min(0.5 * (r_s * r_s + r_p * r_p), 1.0);
        }
    }
    return 1.0;
}

// Schlick's approximation (1994, eq. 15).
float fresnel_schlick(float cos_i, float f0) {
    float x = 1.0 - clamp(cos_i, 0.0, 1.0);
    float x2 = x * x;
    return f0 + (1.0 - f0) * x2 * x2 * x;
}

// F at normal incidence, the same for eta and 1 / eta.
float fresnel_f0_from_index(float eta) {
    float r = (1.0 - eta) / (1.0 + eta);
    return r * r;
}
