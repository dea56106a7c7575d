//! Places whose material has a BRDF or BSDF of its own: a model of `gonio-bsdf`, sampled by its own exact density.
//!
//! Functions that transmit light have their frame about the outside of the surface; all others reflect on both sides, as
//! every other material does. A direction counts only if it is on the same side of the triangle as of the interpolated
//! normal.

use crate::bsdf::{Scattered, Scattering};
use crate::color::ColorMode;
use crate::geometry::Place;
use crate::rules::Rules;
use crate::wavelengths::Wavelengths;
use glam::{DVec3, Vec2, Vec3, Vec4};
use gonio_bsdf::Bsdf;
use gonio_light::vector;
use gonio_scene::MaterialBrdf;

/// How such a place scatters light towards one direction.
pub(crate) struct OwnBrdf<'m> {
    bsdf: &'m dyn Bsdf,
    transmits: bool,
    /// It has values, and not only single directions.
    is_rough: bool,
    blocked_behind: bool,
    /// It counts: the equation in its place is not without its specular term.
    counts: bool,
    mode: ColorMode,
    lambda: Vec4,
    /// Unit, to where the light goes.
    view: Vec3,
    /// The same in the local frame.
    wo: DVec3,
    /// On the viewer's side, or outwards where light is transmitted.
    geometric_normal: Vec3,
    /// Tangent, bitangent and normal.
    frame: [Vec3; 3],
    opacity: f32,
}

impl<'m> OwnBrdf<'m> {
    /// `view`: unit, away from the surface; `normal`: the shading normal.
    pub fn new(
        brdf: &'m MaterialBrdf,
        place: &Place,
        normal: Vec3,
        view: Vec3,
        opacity: f32,
        rules: &Rules,
        (mode, wavelengths): (ColorMode, &Wavelengths),
    ) -> Self {
        let bsdf = brdf.bsdf.as_ref();
        let transmits = bsdf.transmits();
        let side = if place.geometric_normal.dot(view) < 0.0 { -1.0 } else { 1.0 };
        let (mut normal, mut geometric_normal) = (normal, place.geometric_normal);
        if !transmits {
            geometric_normal *= side;
            if rules.equation.is_none() || rules.two_sided {
                normal *= side;
            }
        }
        let is_turned_away = normal.dot(view) * geometric_normal.dot(view) <= 0.0;
        if rules.equation.is_none() && is_turned_away {
            normal = geometric_normal;
        }
        let along = place.tangent.and_then(|(along, _)| (along - normal * normal.dot(along)).try_normalize());
        let tangent = along.unwrap_or_else(|| vector::horizontal_tangent(normal.as_dvec3()).as_vec3());
        let frame = [tangent, normal.cross(tangent), normal];
        OwnBrdf {
            bsdf,
            transmits,
            is_rough: !brdf.is_smooth(),
            blocked_behind: rules.blocked_behind,
            counts: rules.equation.is_none_or(|(equation, _)| equation.terms.specular),
            mode,
            lambda: wavelengths.lambda,
            view,
            wo: to_local(frame, view),
            geometric_normal,
            frame,
            opacity,
        }
    }

    /// The share of light that meets the surface.
    pub fn lit(&self) -> f32 {
        self.opacity
    }

    /// See [`crate::bsdf::Bsdf::is_rough`].
    pub fn is_rough(&self) -> bool {
        self.is_rough && self.counts && self.opacity > 0.0
    }

    /// See [`crate::bsdf::Bsdf::probability_of_surface`].
    pub fn probability_of_surface(&self) -> f32 {
        self.opacity
    }

    /// Whether light from the other side of the surface is scattered to the view.
    pub fn is_lit_behind(&self) -> bool {
        self.transmits
    }

    /// See [`crate::bsdf::Bsdf::is_behind`].
    pub fn is_behind(&self, direction: Vec3) -> bool {
        !self.transmits && self.geometric_normal.dot(direction) <= 0.0
    }

    /// Whether a direction, also in the local frame, is on the same side of the triangle as of the normal.
    fn is_on_one_side(&self, direction: Vec3, wi: DVec3) -> bool {
        let geometric = f64::from(self.geometric_normal.dot(direction));
        if self.transmits { geometric * wi.z > 0.0 } else { wi.z > 0.0 && (geometric > 0.0 || !self.blocked_behind) }
    }

    /// See [`crate::bsdf::Bsdf::evaluate`].
    pub fn evaluate(&self, direction: Vec3) -> (Vec4, f32) {
        let wi = to_local(self.frame, direction);
        if !self.is_on_one_side(direction, wi) {
            return (Vec4::ZERO, 0.0);
        }
        let density = self.bsdf.density(wi, self.wo);
        let value = self.bsdf.evaluate(wi, self.wo) * wi.z.abs();
        (self.in_lanes(value) * self.opacity, density as f32 * self.opacity)
    }

    /// See [`crate::bsdf::Bsdf::sample`].
    pub fn sample(&self, choice: f32, u: Vec2) -> Option<Scattered> {
        let hole = 1.0 - self.opacity;
        if choice < hole {
            let (direction, weight) = (-self.view, Vec4::ONE);
            return Some(Scattered { direction, weight, density: f32::INFINITY, kind: Scattering::Straight });
        }
        let third = f64::from((choice - hole) / self.opacity.max(f32::MIN_POSITIVE));
        let sample = self.bsdf.sample(self.wo, [u.x.into(), u.y.into(), third.min(1.0 - f64::EPSILON)])?;
        let wi = sample.wi;
        let [t, b, n] = self.frame;
        let direction = (t * wi.x as f32 + b * wi.y as f32 + n * wi.z as f32).try_normalize()?;
        if !self.counts || !self.is_on_one_side(direction, wi) {
            return None;
        }
        let density = if sample.is_mirror {
            f32::INFINITY
        } else {
            // A density beyond f32 is that of a lobe as narrow as a mirror's.
            (self.bsdf.density(wi, self.wo) as f32 * self.opacity).min(f32::MAX)
        };
        let kind = if wi.z * self.wo.z < 0.0 { Scattering::Refracted } else { Scattering::Reflected };
        let weight = self.in_lanes(sample.weight);
        (density > 0.0 && weight.is_finite()).then_some(Scattered { direction, weight, density, kind })
    }

    /// A value per channel in the lanes of a path; what is negative or not a number counts as 0.
    fn in_lanes(&self, value: DVec3) -> Vec4 {
        let value = value.as_vec3().map(|channel| if channel > 0.0 { channel } else { 0.0 });
        if self.counts { self.mode.unbounded(value, self.lambda) } else { Vec4::ZERO }
    }
}

fn to_local([t, b, n]: [Vec3; 3], v: Vec3) -> DVec3 {
    // Unit to f64's precision: the models subtract squares of cosines from 1.
    let local = DVec3::new(v.dot(t).into(), v.dot(b).into(), v.dot(n).into());
    local.try_normalize().unwrap_or(DVec3::Z)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::bsdf::tests::place;
    use crate::sampler::Sampler;
    use crate::sampling;
    use gonio_bsdf::{MODELS, ModelSpec, NamedBsdf};

    const RGB: (ColorMode, &Wavelengths) = (ColorMode::Rgb, &Wavelengths::NONE);

    /// The mean weight of samples is the integral of the value over all directions, on both sides where light passes.
    #[test]
    fn samples_and_values_have_the_same_albedo() {
        let mut compared = 0;
        for model in MODELS.iter().filter(|model| model.glsl.is_some() && !model.name.ends_with("-printed")) {
            let brdf = MaterialBrdf::new(NamedBsdf::of_model(&ModelSpec::new(model)));
            let place = place();
            let (t, b) = sampling::frame(place.normal);
            for (angle, side) in [(0.2_f32, 1.0), (1.1, 1.0), (0.7, -1.0)] {
                let view = place.normal * (side * angle.cos()) + (t * 0.8 + b * 0.6) * angle.sin();
                let own = OwnBrdf::new(&brdf, &place, place.normal, view, 0.75, &Rules::EXACT, RGB);
                let count = 1 << 15;
                let (mut sampled, mut straight) = (0.0, 0);
                for i in 0..count {
                    let mut sampler = Sampler::new(5, i, 0);
                    match own.sample(sampler.next_1d(), sampler.next_2d()) {
                        Some(one) if one.kind == Scattering::Straight => straight += 1,
                        Some(one) => sampled += f64::from(one.weight.x),
                        None => {}
                    }
                }
                let sampled = sampled / f64::from(count);
                let (rows, columns) = (1200, 1200);
                let mut integral = 0.0;
                for i in 0..rows * columns {
                    let z = 2.0 * ((i / columns) as f32 + 0.5) / rows as f32 - 1.0;
                    let turn = ((i % columns) as f32 + 0.5) / columns as f32;
                    let local = sampling::from_polar(z, turn);
                    let direction = t * local.x + b * local.y + place.normal * local.z;
                    integral += f64::from(own.evaluate(direction).0.x) * 4.0 * std::f64::consts::PI;
                }
                let integral = integral / f64::from(rows * columns);
                // The noise of 32,768 samples, and the midpoint rule over lobes of a few degrees.
                let tolerance = 0.02 * integral.max(0.2);
                let name = model.name;
                assert!(
                    (sampled - integral).abs() < tolerance,
                    "{name} {angle} {side}: {sampled}, {integral} by a grid"
                );
                assert!(
                    (f64::from(straight) / f64::from(count) - 0.25).abs() < 0.01,
                    "{name}: {straight} through the hole"
                );
                compared += 1;
            }
        }
        assert_eq!(compared, 3 * 19);
    }
}
