//! Places that scatter light diffusely and do nothing else: most of them. What `bsdf` does there, in a tenth of the time.

use crate::bsdf::{Bsdf, Scattered, Scattering};
use crate::geometry::Place;
use crate::own_brdf::OwnBrdf;
use crate::sampling;
use glam::{Vec2, Vec3, Vec4};
use std::f32::consts::FRAC_1_PI;

/// How a place scatters light.
// Never stored: a box would cost more than the space.
#[allow(clippy::large_enum_variant)]
pub(crate) enum Scatter<'r> {
    Diffuse(Diffuse),
    Own(OwnBrdf<'r>),
    Any(Bsdf<'r>),
}

/// A place that only scatters diffusely.
pub(crate) struct Diffuse {
    /// Both unit, on the viewer's side.
    geometric_normal: Vec3,
    normal: Vec3,
    color: Vec4,
}

impl Diffuse {
    /// `view`: unit, away from the surface.
    #[inline]
    pub fn new(place: &Place, view: Vec3, color: Vec4) -> Self {
        let side = 1.0_f32.copysign(place.geometric_normal.dot(view));
        let geometric_normal = place.geometric_normal * side;
        let normal = place.normal * side;
        let normal = if normal.dot(view) <= 0.0 { geometric_normal } else { normal };
        Diffuse { geometric_normal, normal, color }
    }

    #[inline]
    fn evaluate(&self, direction: Vec3) -> (Vec4, f32) {
        let cos = self.normal.dot(direction);
        if cos <= 0.0 || self.geometric_normal.dot(direction) <= 0.0 {
            return (Vec4::ZERO, 0.0);
        }
        let density = cos * FRAC_1_PI;
        (self.color * density, density)
    }

    #[inline]
    fn sample(&self, u: Vec2) -> Option<Scattered> {
        let local = sampling::cosine_hemisphere(u);
        let (tangent, bitangent) = sampling::frame(self.normal);
        let direction = tangent * local.x + bitangent * local.y + self.normal * local.z;
        let found = local.z > 0.0 && self.geometric_normal.dot(direction) > 0.0;
        let density = local.z * FRAC_1_PI;
        found.then_some(Scattered { direction, weight: self.color, density, kind: Scattering::Reflected })
    }
}

impl Scatter<'_> {
    /// See [`Bsdf::lit`].
    pub fn lit(&self) -> f32 {
        match self {
            Scatter::Diffuse(_) => 1.0,
            Scatter::Own(own) => own.lit(),
            Scatter::Any(bsdf) => bsdf.lit,
        }
    }

    /// See [`Bsdf::sample`].
    #[inline]
    pub fn sample(&self, choice: f32, u: Vec2) -> Option<Scattered> {
        match self {
            Scatter::Diffuse(diffuse) => diffuse.sample(u),
            Scatter::Own(own) => own.sample(choice, u),
            Scatter::Any(bsdf) => bsdf.sample(choice, u),
        }
    }

    /// See [`Bsdf::evaluate`].
    #[inline]
    pub fn evaluate(&self, direction: Vec3) -> (Vec4, f32) {
        match self {
            Scatter::Diffuse(diffuse) => diffuse.evaluate(direction),
            Scatter::Own(own) => own.evaluate(direction),
            Scatter::Any(bsdf) => bsdf.evaluate(direction),
        }
    }

    /// See [`Bsdf::is_rough`].
    #[inline]
    pub fn is_rough(&self) -> bool {
        match self {
            Scatter::Diffuse(_) => true,
            Scatter::Own(own) => own.is_rough(),
            Scatter::Any(bsdf) => bsdf.is_rough(),
        }
    }

    /// See [`Bsdf::probability_of_surface`].
    #[inline]
    pub fn probability_of_surface(&self) -> f32 {
        match self {
            Scatter::Diffuse(_) => 1.0,
            Scatter::Own(own) => own.probability_of_surface(),
            Scatter::Any(bsdf) => bsdf.probability_of_surface(),
        }
    }

    /// Whether light from behind the surface, as seen from the view, is scattered to the view.
    #[inline]
    pub fn is_lit_behind(&self) -> bool {
        matches!(self, Scatter::Own(own) if own.is_lit_behind())
    }

    /// See [`Bsdf::is_behind`].
    #[inline]
    pub fn is_behind(&self, direction: Vec3) -> bool {
        match self {
            Scatter::Diffuse(diffuse) => diffuse.geometric_normal.dot(direction) <= 0.0,
            Scatter::Own(own) => own.is_behind(direction),
            Scatter::Any(bsdf) => bsdf.is_behind(direction),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bsdf;
    use crate::material::{Lobe, Parts};
    use crate::rules::Rules;
    use crate::sampler::Sampler;
    use gonio_light::brdf::{BrdfKind, BrdfSettings};

    /// From above, below, and where the interpolated normal is turned away.
    #[test]
    fn scatters_as_the_bsdf_does() {
        let geometric_normal = bsdf::tests::place().geometric_normal;
        let normal = Vec3::new(0.6, 0.7, -0.3).normalize();
        let place = Place { normal, ..bsdf::tests::place() };
        let lambert = Lobe::Brdf(BrdfSettings::new(BrdfKind::Lambert), 1.0);
        let parts = Parts { diffuse: Vec4::new(0.2, 0.5, 0.8, 0.1), ..bsdf::tests::parts(0.0, 0.0, lambert) };
        let turned = (geometric_normal - normal * normal.dot(geometric_normal) - 0.01 * normal).normalize();
        assert!(turned.dot(geometric_normal) > 0.0 && turned.dot(normal) < 0.0);
        for view in [normal, Vec3::new(0.5, -0.7, 0.1).normalize(), turned] {
            let (diffuse, any) =
                (Diffuse::new(&place, view, parts.diffuse), Bsdf::new(&place, normal, view, parts, &Rules::EXACT));
            let mut missed = 0;
            for index in 0..1000 {
                let mut sampler = Sampler::new(7, 0, index);
                let u = sampler.next_2d();
                let (one, other) = (diffuse.sample(u), any.sample(0.5, u));
                assert_eq!(one.is_some(), other.is_some(), "{view} at {u}");
                let direction = match one.zip(other) {
                    Some((one, other)) => {
                        assert!(one.direction.abs_diff_eq(other.direction, 1e-6), "{view}: {one:?}, {other:?}");
                        assert!(one.weight.abs_diff_eq(other.weight, 1e-5), "{view}: {one:?}, {other:?}");
                        assert!((one.density - other.density).abs() < 1e-5, "{view}: {one:?}, {other:?}");
                        one.direction
                    }
                    None => {
                        missed += 1;
                        sampling::from_polar(2.0 * u.x - 1.0, u.y)
                    }
                };
                let ((value, density), (expected, expected_density)) =
                    (diffuse.evaluate(direction), any.evaluate(direction));
                assert!(value.abs_diff_eq(expected, 1e-6), "{view}: {value} instead of {expected}");
                assert!((density - expected_density).abs() < 1e-6, "{view}: {density} instead of {expected_density}");
            }
            assert!(missed < 200, "{view}: {missed}");
            assert!(missed > 0 || view == turned, "some directions are on the other side of the triangle");
        }
    }
}
