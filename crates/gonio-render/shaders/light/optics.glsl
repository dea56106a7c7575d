// Reflection and refraction of the surroundings: twins of gonio-light's optics.rs, in f32. Symbols and ranges are documented there.
// From Rust: FRESNEL_NONE, FRESNEL_EXACT, FRESNEL_SCHLICK.

struct Boundary {
    vec3 reflected;      // R
    vec3 transmitted;    // T; 0 for total reflection
    bool transmits;
    float reflectance;   // F; 1 for total reflection
};

struct Sight {
    vec3 reflection;     // R
    vec3 reflected;      // E(R)
    vec3 transmitted;    // (1 - F) tint E(T)
    vec3 fresnel;        // F of each channel
};

// F for the cosine on the side of the ray; eta is the index there divided by the one beyond.
float reflectance(int kind, float cos_i, float eta) {
    float cos2_t = 1.0 - eta * eta * (1.0 - cos_i * cos_i);
    if (cos2_t < 0.0) return 1.0;
    if (kind == FRESNEL_EXACT) return fresnel_dielectric(cos_i, eta);
    // With the cosine on the side of the lower index, because Schlick's formula does not contain the critical angle.
    if (kind == FRESNEL_SCHLICK) return fresnel_schlick(eta > 1.0 ? sqrt(cos2_t) : cos_i, fresnel_f0_from_index(eta));
    return 0.0;
}

// The ray of sight at a boundary between the outside and a material of this index.
Boundary boundary(vec3 n, vec3 v, float index, int kind) {
    bool outside = dot(n, v) >= 0.0;
    vec3 towards = outside ? n : -n;
    float eta = outside ? 1.0 / index : index;
    Boundary b;
    b.reflected = reflection(towards, v);
    b.transmits = refraction(towards, v, eta, b.transmitted);
    // Light that is not transmitted is reflected, even if rounding elsewhere gave another sign of the radicand.
    b.reflectance = b.transmits ? reflectance(kind, dot(towards, v), eta) : 1.0;
    return b;
}

// w, where the boundary has the Fresnel factor f.
float mirror_share(int kind, float reflectivity, float f) {
    return kind == FRESNEL_NONE ? reflectivity : reflectivity * f;
}

// L, from the value of the light equation and the light of the surroundings.
vec3 compose(vec3 lit, Sight seen, int kind, float reflectivity, float transmission) {
    float share = mirror_share(kind, reflectivity, seen.fresnel.g);
    vec3 opaque = lit * (1.0 - share) + seen.reflected * share;
    vec3 clear = seen.fresnel * seen.reflected + seen.transmitted;
    return opaque * (1.0 - transmission) + clear * transmission;
}
