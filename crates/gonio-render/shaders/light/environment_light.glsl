// Light of the environment: twins of gonio-environment's harmonics.rs and prefilter.rs, and of
// gonio-light's microfacet.rs, in f32. Sources are listed there.

// The light that falls on a surface with this normal (in the environment): the integral of radiance times cosine. Never
// negative.
vec3 irradiance(vec3 polynomial[9], vec3 n) {
    vec3 sum = polynomial[0] + polynomial[1] * n.y + polynomial[2] * n.z + polynomial[3] * n.x + polynomial[4] * (n.x * n.y)
        + polynomial[5] * (n.y * n.z) + polynomial[6] * (3.0 * n.z * n.z - 1.0) + polynomial[7] * (n.x * n.z)
        + polynomial[8] * (n.x * n.x - n.y * n.y);
    return max(sum, vec3(0.0));
}

// The roughness of an exponent, in (0, 1].
float roughness_of_shininess(float shininess) {
    return sqrt(sqrt(2.0 / (max(shininess, 0.0) + 2.0)));
}

// The direction of the middle of a rough mirror's lobe; not of unit length. Roughness in [0, 1].
vec3 dominant_direction(vec3 n, vec3 v, float roughness) {
    float alpha = roughness * roughness;
    float smoothness = 1.0 - alpha;
    return mix(n, reflection(n, v), smoothness * (sqrt(smoothness) + alpha));
}
