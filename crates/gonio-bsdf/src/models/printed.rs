//! Formulas exactly as Appendix 6 prints them. They have no meaning from which to sample, so samples follow the cosine.

use crate::bsdf::{Bsdf, both_above};
use gonio_light::DVec3;

/// `a / pi + term(b, wi, wo)`, each channel with its own `b`.
pub struct PrintedFormula<T> {
    pub a: DVec3,
    pub b: DVec3,
    pub is_isotropic: bool,
    pub term: T,
}

impl<T: Fn(f64, DVec3, DVec3) -> f64 + Send + Sync> Bsdf for PrintedFormula<T> {
    fn evaluate(&self, wi: DVec3, wo: DVec3) -> DVec3 {
        if both_above(wi, wo) {
            self.a * std::f64::consts::FRAC_1_PI + self.b.map(|b| (self.term)(b, wi, wo))
        } else {
            DVec3::ZERO
        }
    }

    fn samples_follow_function(&self) -> bool {
        false
    }

    fn is_isotropic(&self) -> bool {
        self.is_isotropic
    }
}
