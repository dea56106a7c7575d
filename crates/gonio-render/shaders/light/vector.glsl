// The vectors of the equation: twins of gonio-light's vector.rs, in f32.
// From Rust: DEGENERATE_LENGTH, LEAST_TILT.

// Lengths from 1e-12 to 1.8e19 have squares that f32 holds; outside of that range a vector counts as
// degenerate here (the Rust twin scales first and has no upper limit). The comparison fails for NaN.
bool has_direction(float vector_length) {
    return vector_length >= DEGENERATE_LENGTH && vector_length <= 1.8e19;
}

// v at unit length, or fallback if its length is degenerate.
vec3 unit_or(vec3 v, vec3 fallback) {
    float vector_length = length(v);
    return has_direction(vector_length) ? v / vector_length : fallback;
}

// R = 2 (N.L) N - L. (GLSL's reflect takes the vector that points to the surface.)
vec3 reflection(vec3 n, vec3 l) {
    return 2.0 * dot(n, l) * n - l;
}

// H = (L + V) / |L + V|; n if l and v are opposite.
vec3 half_vector(vec3 l, vec3 v, vec3 n) {
    return unit_or(l + v, n);
}

// The seed's T = (eta N.L - sqrt(1 - eta^2 (1 - (N.L)^2))) N - eta L, eta = eta_L / eta_T.
// False, and t = 0, if the radicand is negative: total internal reflection.
bool refraction(vec3 n, vec3 l, float eta, out vec3 t) {
    float cos_l = dot(n, l);
    // The part of L across N. Its square is 1 - (N.L)^2 for unit vectors, without the cancellation that
    // f32 would show near normal incidence.
    vec3 across = cos_l * n - l;
    float radicand = 1.0 - eta * eta * dot(across, across);
    t = vec3(0.0);
    if (radicand >= 0.0) {
        t = eta * across - sqrt(radicand) * n;
        return true;
    }
    return false;
}

// A unit vector perpendicular to the unit vector n (Duff et al. 2017).
vec3 any_orthonormal_vector(vec3 n) {
    float s = n.z >= 0.0 ? 1.0 : -1.0;
    float a = -1.0 / (s + n.z);
    return vec3(n.x * n.y * a, s + n.y * n.y * a, -n.y);
}

// A unit vector perpendicular to n that runs around the vertical axis; the world's X where n is vertical.
vec3 horizontal_tangent(vec3 n) {
    float across = length(n.xz);
    return across > LEAST_TILT ? vec3(n.z, 0.0, -n.x) / across : vec3(1.0, 0.0, 0.0) - n.x * n;
}

// Tangent and bitangent that are perpendicular to the unit normal n.
void tangent_frame(vec3 n, vec3 tangent, out vec3 t, out vec3 b) {
    t = unit_or(tangent - dot(n, tangent) * n, any_orthonormal_vector(n));
    b = cross(n, t);
}
