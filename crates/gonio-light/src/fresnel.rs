//! Fresnel factors: the share of the light that is reflected at the boundary of two media.
//!
//! `eta = eta_L / eta_T` throughout, as in [`vector::refraction`](crate::vector::refraction): the index
//! of refraction on the light's side over the one on the other side.

use crate::color::unit_interval;

named_enum! {
    /// Materials of the lab's table of refraction indices.
    pub enum Medium {
        /// Index 1.00
        Air = "air",
        /// Index 1.33
        Water = "water",
        /// Index 1.309
        Ice = "ice",
        /// Index 1.52
        Glass = "glass",
        /// Index 2.42
        Diamond = "diamond",
    }
    default Glass;
    what "medium";
}

impl Medium {
    /// The index of refraction by the lab's table (for yellow light, about 589 nm).
    pub const fn refraction_index(self) -> f64 {
        match self {
            Medium::Air => 1.00,
            Medium::Water => 1.33,
            Medium::Ice => 1.309,
            Medium::Glass => 1.52,
            Medium::Diamond => 2.42,
        }
    }
}

/// The share of unpolarised light that a smooth boundary of two dielectrics reflects, in `[0, 1]`.
///
/// ```text
/// r_s = (eta cos_i - cos_t) / (eta cos_i + cos_t)
/// r_p = (cos_i - eta cos_t) / (cos_i + eta cos_t)     F = (r_s^2 + r_p^2) / 2
/// ```
///
/// `cos_i` is the cosine between the incoming direction and the normal on its side, held in `[0, 1]`;
/// `eta > 0`. 1 where reflection is total, and for an `eta` that is not a positive number; 0 for
/// `eta = 1` (no boundary). Source: M. Born and E. Wolf, *Principles of Optics*, section 1.5.2, (21).
pub fn dielectric(cos_i: f64, eta: f64) -> f64 {
    if eta == 1.0 {
        return 0.0;
    }
    let cos_i = unit_interval(cos_i);
    let cos2_t = 1.0 - eta * eta * (1.0 - cos_i * cos_i);
    // Conditions that hold, not ones that fail: NaN then ends at the 1 below.
    if eta > 0.0 && cos2_t >= 0.0 {
        let cos_t = cos2_t.sqrt();
        let (s_sum, p_sum) = (eta * cos_i + cos_t, cos_i + eta * cos_t);
        if s_sum > 0.0 && p_sum > 0.0 && s_sum.is_finite() && p_sum.is_finite() {
            let r_s = (eta * cos_i - cos_t) / s_sum;
            let r_p = (cos_i - eta * cos_t) / p_sum;
            return unit_interval(0.5 * (r_s * r_s + r_p * r_p));
        }
    }
    1.0
}

/// Schlick's approximation `f0 + (1 - f0)(1 - cos)^5`, `cos` held in `[0, 1]`.
///
/// For light that enters the denser medium; from inside it is right only with the cosine on the outer
/// side, and it knows no total reflection. Source: C. Schlick, *An Inexpensive BRDF Model for
/// Physically-based Rendering*, Computer Graphics Forum 13(3), 1994, eq. (15).
pub fn schlick(cos: f64, f0: f64) -> f64 {
    let x = 1.0 - unit_interval(cos);
    let x2 = x * x;
    f0 + (1.0 - f0) * x2 * x2 * x
}

/// `F` at normal incidence, `((1 - eta) / (1 + eta))^2`, for a relative index `eta` > 0. The same for
/// `eta` and `1 / eta`: against air it is enough to give the material's own index.
pub fn f0_from_index(eta: f64) -> f64 {
    let r = (1.0 - eta) / (1.0 + eta);
    r * r
}

/// The angle of incidence in radians from which reflection is total, `asin(1 / eta)`; `None` where
/// it never is (`eta <= 1`, from the thinner medium into the denser one).
pub fn critical_angle_rad(eta: f64) -> Option<f64> {
    (eta > 1.0).then(|| (1.0 / eta).asin())
}
