//! Scattering as the simplifications change it.

use crate::bsdf::Bsdf;
use crate::material::Lobe;
use crate::sampling;
use glam::{Vec3, Vec4};
use gonio_light::{Equation, Surface};
use std::f32::consts::FRAC_1_PI;

/// What the simplifications change about the way in which surfaces scatter light.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rules {
    /// The diffuse and the specular term of this equation in place of the BRDF, times this factor
    /// ([`Simplification::Brdf`](crate::Simplification::Brdf)).
    pub equation: Option<(Equation, f32)>,
    pub specular: SpecularCosine,
    /// A surface blocks the light behind it.
    pub blocked_behind: bool,
    /// With `equation`: the normal is turned to the viewer on back faces.
    pub two_sided: bool,
}

/// The factor of the glossy part in place of `<N.L>`, where no equation replaces it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum SpecularCosine {
    /// `<N.L>`
    Weighted,
    /// 1 where `N.L > 0`.
    Gated,
    /// 1.
    Free,
}

impl Rules {
    /// Nothing is simplified.
    #[cfg(test)]
    pub const EXACT: Rules =
        Rules { equation: None, specular: SpecularCosine::Weighted, blocked_behind: true, two_sided: true };

    pub fn are_exact(&self) -> bool {
        self.equation.is_none() && self.specular == SpecularCosine::Weighted && self.blocked_behind
    }
}

impl Bsdf<'_> {
    /// [`Self::evaluate`] by the rules.
    pub fn evaluate_simplified(&self, direction: Vec3) -> (Vec4, f32) {
        if self.rules.blocked_behind && self.is_behind(direction) {
            return (Vec4::ZERO, 0.0);
        }
        let cos = self.normal.dot(direction);
        let mut density = self.probabilities[0] * sampling::cosine_density(cos);
        if self.probabilities[1] > 0.0 {
            density += self.probabilities[1] * self.lobe_density(direction);
        }
        let lambert = cos.max(0.0);
        let value = match (&self.rules.equation, self.parts.lobe) {
            (Some((equation, factor)), Lobe::Brdf(_, shininess)) => {
                let surface = Surface { shininess, ..Surface::default() };
                let (diff, spec) = equation.factors(&self.shading_point(), &surface, direction.as_dvec3());
                (self.diffuse * (diff as f32 * lambert) + self.glossy * spec as f32) * *factor
            }
            (_, lobe) => {
                let weight = match (self.rules.specular, lobe) {
                    (SpecularCosine::Weighted, _) => lambert,
                    (SpecularCosine::Free, Lobe::Brdf(..)) => 1.0,
                    _ if cos > 0.0 => 1.0,
                    _ => 0.0,
                };
                if self.probabilities[1] > 0.0 && weight > 0.0 {
                    let (glossy, under) = self.glossy_value(direction, cos);
                    self.diffuse * (FRAC_1_PI * under * lambert) + glossy * weight
                } else {
                    self.diffuse * (FRAC_1_PI * lambert)
                }
            }
        };
        (value, density)
    }
}
