//! The vectors of the equation, from one another.

use glam::DVec3;

/// Below this length a vector has no direction, and the next best one stands in for it.
pub const DEGENERATE_LENGTH: f64 = 1e-12;

/// `v` at unit length, or `None` where it is shorter than [`DEGENERATE_LENGTH`] or not finite.
pub fn unit(v: DVec3) -> Option<DVec3> {
    let length = v.length();
    (length >= DEGENERATE_LENGTH && length.is_finite()).then(|| v / length)
}

/// `R = 2 (N.L) N - L`: `l` mirrored about `n`. Both unit vectors that point away from the surface;
/// so does the result. (GLSL's `reflect` takes the vector that points *to* the surface.)
pub fn reflection(n: DVec3, l: DVec3) -> DVec3 {
    2.0 * n.dot(l) * n - l
}

/// `H = (L + V) / |L + V|`; `n` where `l` and `v` are opposite and no half vector exists.
pub fn half_vector(l: DVec3, v: DVec3, n: DVec3) -> DVec3 {
    unit(l + v).unwrap_or(n)
}

/// The seed's refraction vector
/// `T = (eta N.L - sqrt(1 - eta^2 (1 - (N.L)^2))) N - eta L`, `eta = eta_L / eta_T`,
/// or `None` where the radicand is negative: total internal reflection.
///
/// `n` and `l` are unit vectors away from the surface, `n.l >= 0`; `T` points into the other medium.
pub fn refraction(n: DVec3, l: DVec3, eta: f64) -> Option<DVec3> {
    let cos_l = n.dot(l);
    let radicand = 1.0 - eta * eta * (1.0 - cos_l * cos_l);
    (radicand >= 0.0).then(|| (eta * cos_l - radicand.sqrt()) * n - eta * l)
}
