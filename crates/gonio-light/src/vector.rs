//! Vectors of the equation from one another: reflection, refraction, half vector, frames.

use glam::DVec3;

/// Below this length a vector has no direction, and a fallback replaces it.
pub const DEGENERATE_LENGTH: f64 = 1e-12;

/// `|v|`, also where the squares of its components would overflow or vanish; infinite or NaN only if
/// `v` is not finite or its true length is beyond `f64`.
pub fn safe_length(v: DVec3) -> f64 {
    let largest = v.abs().max_element();
    if largest > 0.0 && largest.is_finite() { largest * (v / largest).length() } else { v.length() }
}

/// `v` at unit length, or `None` where it is shorter than [`DEGENERATE_LENGTH`] or not finite.
pub fn unit(v: DVec3) -> Option<DVec3> {
    let largest = v.abs().max_element();
    if !v.is_finite() || safe_length(v) < DEGENERATE_LENGTH {
        return None;
    }
    // Scaled first, so that neither a length of 1e300 nor one of 1e-12 loses digits.
    let scaled = v / largest;
    Some(scaled / scaled.length())
}

/// `v` at unit length, or `fallback` where it has none ([`unit()`]).
pub fn unit_or(v: DVec3, fallback: DVec3) -> DVec3 {
    unit(v).unwrap_or(fallback)
}

/// `R = 2 (N.L) N - L`: `l` mirrored about `n`. Both unit vectors that point away from the surface;
/// so does the result. (GLSL's `reflect` takes the vector that points *to* the surface.)
pub fn reflection(n: DVec3, l: DVec3) -> DVec3 {
    2.0 * n.dot(l) * n - l
}

/// `H = (L + V) / |L + V|`; `n` where `l` and `v` are opposite and no half vector exists.
pub fn half_vector(l: DVec3, v: DVec3, n: DVec3) -> DVec3 {
    unit_or(l + v, n)
}

/// The seed's refraction vector
/// `T = (eta N.L - sqrt(1 - eta^2 (1 - (N.L)^2))) N - eta L`, `eta = eta_L / eta_T`,
/// or `None` where the radicand is negative (or not a number): total internal reflection.
///
/// `n` and `l` are unit vectors away from the surface, `n.l >= 0`; `T` points into the other medium
/// and is a unit vector by Snell's law.
pub fn refraction(n: DVec3, l: DVec3, eta: f64) -> Option<DVec3> {
    let cos_l = n.dot(l);
    // The part of L across N; its square is 1 - (N.L)^2, without the cancellation near normal incidence
    // that f32 would show on the GPU.
    let across = cos_l * n - l;
    let radicand = 1.0 - eta * eta * across.length_squared();
    (radicand >= 0.0).then(|| eta * across - radicand.sqrt() * n)
}

/// A unit vector perpendicular to the unit vector `n`, without a branch that is near its own limit
/// (T. Duff et al., *Building an Orthonormal Basis, Revisited*, JCGT 6(1), 2017).
pub fn any_orthonormal_vector(n: DVec3) -> DVec3 {
    let sign = if n.z >= 0.0 { 1.0 } else { -1.0 };
    let a = -1.0 / (sign + n.z);
    DVec3::new(n.x * n.y * a, sign + n.y * n.y * a, -n.y)
}

/// A unit vector perpendicular to the unit vector `n` that runs around the vertical axis, `Y x N`: the direction of grooves
/// on something that was turned on a lathe. The world's X where `n` is vertical.
pub fn horizontal_tangent(n: DVec3) -> DVec3 {
    let across = DVec3::new(n.z, 0.0, -n.x);
    // Less is a normal that differs from the vertical by the rounding of f32 only.
    if across.length() > LEAST_TILT { across.normalize() } else { DVec3::X - n.x * n }
}

/// The sine of the angle between a normal and the vertical below which [`horizontal_tangent`] is the world's X.
pub const LEAST_TILT: f64 = 1e-5;

/// Tangent and bitangent perpendicular to the unit normal `n`: the part of `tangent` across `n`,
/// at unit length ([`any_orthonormal_vector`] where there is none), and `n x tangent`.
pub fn tangent_frame(n: DVec3, tangent: DVec3) -> (DVec3, DVec3) {
    let t = unit(tangent - n.dot(tangent) * n).unwrap_or_else(|| any_orthonormal_vector(n));
    (t, n.cross(t))
}
