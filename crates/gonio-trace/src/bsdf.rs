//! How a place scatters light: a diffuse part and a glossy lobe, a mirror, a clear boundary, and what passes through a
//! surface that is not opaque.
//!
//! | part | value | sampled by |
//! |---|---|---|
//! | diffuse | `k_d / pi` | the cosine |
//! | glossy | `k_s` times the normalised lobe of `gonio-light`, or GGX for metal-roughness materials | a lobe about the mirror direction or the normal |
//! | mirror | reflectivity, by the Fresnel factor | its one direction |
//! | clear | transmission: Fresnel's `F` reflected, `1 - F` refracted | their two directions |
//! | hole | 1 - opacity | straight on |
//!
//! Mirror, clear part and hole take their shares from the diffuse and glossy parts as `gonio_light::Optics` does, so
//! that no part adds energy. Both sides of a surface reflect. A direction counts as reflected only if it is
//! on the viewer's side of the triangle as well as of the interpolated normal.

use crate::geometry::Place;
use crate::material::{Lobe, Parts};
use crate::rules::Rules;
use crate::sampling;
use glam::{DVec3, Vec2, Vec3, Vec4};
use gonio_environment::BrdfTable;
use gonio_light::brdf::{BrdfKind, BrdfSettings, effective_shininess, ward};
use gonio_light::{ShadingPoint, Surface, microfacet};
use std::f32::consts::FRAC_1_PI;

/// How a place scatters light towards one direction.
pub(crate) struct Bsdf<'r> {
    pub(crate) rules: &'r Rules,
    /// `rules` change nothing.
    exact: bool,
    /// Unit, to where the light goes.
    view: Vec3,
    /// On the viewer's side.
    geometric_normal: Vec3,
    /// Shading normal on the viewer's side, and a frame about it.
    pub(crate) normal: Vec3,
    tangent: Vec3,
    bitangent: Vec3,
    pub(crate) parts: Parts,
    /// Weights of diffuse and glossy part: what mirror, clear part and hole leave.
    pub(crate) diffuse: Vec4,
    pub(crate) glossy: Vec4,
    /// The share of light that meets neither mirror nor clear part nor hole.
    pub lit: f32,
    /// Probabilities of the parts, in the order of the table.
    pub(crate) probabilities: [f32; 5],
}

/// A direction that light comes from.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scattered {
    pub direction: Vec3,
    /// BSDF times cosine over density.
    pub weight: Vec4,
    /// In 1/sr; infinite for a single direction.
    pub density: f32,
    pub kind: Scattering,
}

/// The way light took at a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Scattering {
    Reflected,
    Refracted,
    /// Through a hole, not deflected.
    Straight,
}

impl<'r> Bsdf<'r> {
    /// `view`: unit, away from the surface.
    pub fn new(place: &Place, normal: Vec3, view: Vec3, parts: Parts, rules: &'r Rules) -> Self {
        let side = if place.geometric_normal.dot(view) < 0.0 { -1.0 } else { 1.0 };
        let geometric_normal = place.geometric_normal * side;
        let mut normal = normal;
        if rules.equation.is_none() || rules.two_sided {
            normal *= side;
        }
        if rules.equation.is_none() && normal.dot(view) <= 0.0 {
            normal = geometric_normal;
        }
        let (tangent, bitangent) = match place.tangent {
            Some((along, _)) => match (along - normal * normal.dot(along)).try_normalize() {
                Some(tangent) => (tangent, normal.cross(tangent)),
                None => sampling::frame(normal),
            },
            None => sampling::frame(normal),
        };
        let lit = (1.0 - parts.mirror) * (1.0 - parts.clear) * parts.opacity;
        let (diffuse, glossy) = (parts.diffuse * lit, parts.glossy * lit);
        let mirror = (parts.mirror * (1.0 - parts.clear) + parts.clear * parts.clear_reflectance) * parts.opacity;
        let refraction = match parts.refracted {
            Some(_) => parts.clear * (1.0 - parts.clear_reflectance) * parts.opacity,
            None => 0.0,
        };
        let refraction_color = parts.refraction_weight.max_element().min(1.0);
        let shares =
            [diffuse.max_element(), glossy.max_element(), mirror, refraction * refraction_color, 1.0 - parts.opacity];
        let sum: f32 = shares.iter().sum();
        let probabilities = if sum > 0.0 { shares.map(|s| s / sum) } else { [0.0; 5] };
        let exact = rules.are_exact();
        Bsdf {
            rules,
            exact,
            view,
            geometric_normal,
            normal,
            tangent,
            bitangent,
            parts,
            diffuse,
            glossy,
            lit,
            probabilities,
        }
    }

    /// Whether light from many directions is scattered to the view: else lights need not be sampled.
    pub fn is_rough(&self) -> bool {
        self.probabilities[0] + self.probabilities[1] > 0.0
    }

    /// The probability that [`Self::sample`] does not go straight on: light that is scattered is found only then.
    pub fn probability_of_surface(&self) -> f32 {
        1.0 - self.probabilities[4]
    }

    /// BSDF times cosine for light from `direction`, and the density with which [`Self::sample`] finds it. Only the
    /// diffuse and glossy parts: the others have no value.
    pub fn evaluate(&self, direction: Vec3) -> (Vec4, f32) {
        if !self.exact {
            return self.evaluate_simplified(direction);
        }
        let cos = self.normal.dot(direction);
        if cos <= 0.0 || self.geometric_normal.dot(direction) <= 0.0 {
            return (Vec4::ZERO, 0.0);
        }
        let mut value = self.diffuse * FRAC_1_PI;
        let mut density = self.probabilities[0] * sampling::cosine_density(cos);
        if self.probabilities[1] > 0.0 {
            let (glossy, under) = self.glossy_value(direction, cos);
            value = value * under + glossy;
            density += self.probabilities[1] * self.lobe_density(direction);
        }
        (value * cos, density)
    }

    /// Whether the surface is between the viewer and light from `direction`.
    pub fn is_behind(&self, direction: Vec3) -> bool {
        self.geometric_normal.dot(direction) <= 0.0
    }

    pub(crate) fn shading_point(&self) -> ShadingPoint {
        ShadingPoint {
            position: DVec3::ZERO,
            normal: self.normal.as_dvec3(),
            view: self.view.as_dvec3(),
            tangent: self.tangent.as_dvec3(),
        }
    }

    /// The glossy part for light from `direction`, and the share of light that it leaves to the diffuse part.
    pub(crate) fn glossy_value(&self, direction: Vec3, cos: f32) -> (Vec4, f32) {
        match self.parts.lobe {
            Lobe::Brdf(brdf, shininess) => {
                let surface = Surface { shininess, ..Surface::default() };
                (self.glossy * brdf.lobe(&self.shading_point(), &surface, direction.as_dvec3()) as f32, 1.0)
            }
            Lobe::Ggx(alpha) => {
                let Some(half) = (self.view + direction).try_normalize() else { return (Vec4::ZERO, 1.0) };
                let schlick = (1.0 - self.view.dot(half).clamp(0.0, 1.0)).powi(5);
                let d = microfacet::distribution(self.normal.dot(half).into(), alpha);
                let vis = microfacet::visibility(self.normal.dot(self.view).into(), cos.into(), alpha);
                let lit = self.parts.glossy.max_element().max(1e-6);
                // Schlick's factor with the glossy colour as its value at normal incidence; `lit` carries the shares.
                let share = self.glossy.max_element() / lit;
                let fresnel = self.parts.glossy + (Vec4::ONE - self.parts.glossy) * schlick;
                (fresnel * share * (d * vis) as f32, self.left_by_facets(cos, alpha))
            }
        }
    }

    /// The share of light that microfacets leave to the diffuse part: what they do not reflect of even light, at the flatter
    /// of both angles. glTF's `1 - F(V.H)` would reflect up to a quarter more light than arrives.
    fn left_by_facets(&self, cos: f32, alpha: f64) -> f32 {
        if self.diffuse == Vec4::ZERO {
            return 0.0;
        }
        let reflected = |cos: f32| {
            let (scale, bias) = BrdfTable::get().lookup(cos.into(), alpha.sqrt());
            self.parts.glossy.max_element() * scale as f32 + bias as f32
        };
        1.0 - reflected(cos).max(reflected(self.normal.dot(self.view))).min(1.0)
    }

    /// A direction of the glossy part, in the world.
    fn sample_lobe(&self, u: Vec2) -> Option<Vec3> {
        match self.parts.lobe {
            Lobe::Brdf(brdf, shininess) => match brdf.kind {
                BrdfKind::Lambert => None,
                BrdfKind::Phong | BrdfKind::Lafortune => {
                    let axis = self.lobe_axis(brdf)?;
                    let (t, b) = sampling::frame(axis);
                    let local = sampling::cosine_power(u, effective_shininess(shininess) as f32);
                    Some((t * local.x + b * local.y + axis * local.z).normalize())
                }
                BrdfKind::Blinn => {
                    let local = sampling::cosine_power(u, effective_shininess(shininess) as f32);
                    self.mirrored_at(local)
                }
                BrdfKind::Ward => {
                    let c = ward::roughness(shininess) as f32;
                    let tan2 = -c * c * (1.0 - u.x).ln();
                    self.mirrored_at(sampling::from_polar(1.0 / (1.0 + tan2).sqrt(), u.y))
                }
            },
            Lobe::Ggx(alpha) => {
                let view = self.to_local(self.view).as_dvec3();
                if view.z <= 0.0 {
                    return None;
                }
                self.mirrored_at(microfacet::visible_facet(view, alpha, u.x.into(), u.y.into()).as_vec3())
            }
        }
    }

    /// The density of [`Self::sample_lobe`], in 1/sr.
    pub(crate) fn lobe_density(&self, direction: Vec3) -> f32 {
        let about_half = |density: &dyn Fn(f32) -> f32| {
            let Some(half) = (self.view + direction).try_normalize() else { return 0.0 };
            let (cos_h, cos_d) = (self.normal.dot(half), self.view.dot(half));
            if cos_h <= 0.0 || cos_d <= 0.0 { 0.0 } else { density(cos_h) / (4.0 * cos_d) }
        };
        match self.parts.lobe {
            Lobe::Brdf(brdf, shininess) => {
                let exponent = effective_shininess(shininess) as f32;
                match brdf.kind {
                    BrdfKind::Lambert => 0.0,
                    BrdfKind::Phong | BrdfKind::Lafortune => self
                        .lobe_axis(brdf)
                        .map_or(0.0, |axis| sampling::cosine_power_density(axis.dot(direction), exponent)),
                    BrdfKind::Blinn => about_half(&|cos_h| sampling::cosine_power_density(cos_h, exponent)),
                    BrdfKind::Ward => about_half(&|cos_h| {
                        let c2 = (ward::roughness(shininess) as f32).powi(2);
                        let cos2 = cos_h * cos_h;
                        let tan2 = (1.0 - cos2).max(0.0) / cos2;
                        FRAC_1_PI / (c2 * cos2 * cos_h) * (-tan2 / c2).exp()
                    }),
                }
            }
            Lobe::Ggx(alpha) => {
                let cos_v = f64::from(self.normal.dot(self.view));
                about_half(&|cos_h| {
                    // Visible normals: D G1 <V.H> / cos_v, and the Jacobian below divides by 4 <V.H>.
                    let Some(half) = (self.view + direction).try_normalize() else { return 0.0 };
                    let a2 = alpha * alpha;
                    let g1 = 2.0 * cos_v / (cos_v + (a2 + (1.0 - a2) * cos_v * cos_v).sqrt());
                    let d = microfacet::distribution(cos_h.into(), alpha);
                    (d * g1 / cos_v) as f32 * self.view.dot(half)
                })
            }
        }
    }

    /// The direction about which a Phong or Lafortune lobe lies: the view, each axis of the local frame scaled.
    fn lobe_axis(&self, brdf: BrdfSettings) -> Option<Vec3> {
        let scale = match brdf.kind {
            BrdfKind::Lafortune => brdf.lafortune.as_vec3(),
            _ => Vec3::new(1.0, 1.0, -1.0),
        };
        // <-V^T A L>: the lobe is largest where L points along -A V.
        let axis = self.to_local(self.view) * -scale;
        Some(self.to_world(axis.try_normalize()?))
    }

    /// The view, mirrored at a half vector of the local frame.
    fn mirrored_at(&self, half: Vec3) -> Option<Vec3> {
        let half = self.to_world(half);
        let cos = self.view.dot(half);
        (cos > 0.0).then(|| (2.0 * cos * half - self.view).normalize())
    }

    fn to_local(&self, v: Vec3) -> Vec3 {
        Vec3::new(v.dot(self.tangent), v.dot(self.bitangent), v.dot(self.normal))
    }

    fn to_world(&self, v: Vec3) -> Vec3 {
        self.tangent * v.x + self.bitangent * v.y + self.normal * v.z
    }

    /// A direction that light comes from; `choice` in `[0, 1)` chooses the part. `None` where nothing is scattered.
    pub fn sample(&self, choice: f32, u: Vec2) -> Option<Scattered> {
        let p = self.probabilities;
        let mut at = choice;
        let part = (0..5).find(|&i| {
            let here = at < p[i];
            at -= p[i];
            here
        });
        let Parts { mirror, clear, clear_reflectance, opacity, .. } = self.parts;
        let single = |direction: Vec3, value: Vec4, probability: f32, kind: Scattering| {
            Some(Scattered { direction, weight: value / probability, density: f32::INFINITY, kind })
        };
        // Rounding may leave a remainder beyond the last part.
        match part.or_else(|| (0..5).rev().find(|&i| p[i] > 0.0))? {
            0 => self.rough(self.to_world(sampling::cosine_hemisphere(u))),
            1 => self.rough(self.sample_lobe(u)?),
            2 => {
                let reflected = 2.0 * self.normal.dot(self.view) * self.normal - self.view;
                let value = (mirror * (1.0 - clear) + clear * clear_reflectance) * opacity;
                if self.geometric_normal.dot(reflected) <= 0.0 {
                    return None;
                }
                single(reflected.normalize(), Vec4::splat(value), p[2], Scattering::Reflected)
            }
            3 => {
                let value = self.parts.refraction_weight * (clear * (1.0 - clear_reflectance) * opacity);
                single(self.parts.refracted?, value, p[3], Scattering::Refracted)
            }
            _ => single(-self.view, Vec4::splat(1.0 - opacity), p[4], Scattering::Straight),
        }
    }

    fn rough(&self, direction: Vec3) -> Option<Scattered> {
        let (value, density) = self.evaluate(direction);
        (density > 0.0).then(|| Scattered { direction, weight: value / density, density, kind: Scattering::Reflected })
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::sampler::Sampler;
    use gonio_light::DVec3 as V;
    use std::f32::consts::{PI, TAU};

    pub(crate) fn parts(diffuse: f32, glossy: f32, lobe: Lobe) -> Parts {
        Parts {
            diffuse: Vec4::splat(diffuse),
            glossy: Vec4::splat(glossy),
            lobe,
            mirror: 0.0,
            clear: 0.0,
            clear_reflectance: 0.0,
            refracted: None,
            refraction_weight: Vec4::ONE,
            opacity: 1.0,
        }
    }

    pub(crate) fn place() -> Place {
        let normal = Vec3::new(0.2, 0.9, -0.3).normalize();
        Place {
            position: Vec3::ZERO,
            error: 0.0,
            geometric_normal: normal,
            normal,
            normal_turned: false,
            flat: false,
            tangent: None,
            uv: Vec2::ZERO,
            color: Vec3::ONE,
        }
    }

    fn lobes() -> Vec<(&'static str, f32, f32, Lobe)> {
        let brdf = |kind, lafortune: V| BrdfSettings { kind, normalised: true, lafortune };
        let phong = V::new(1.0, 1.0, -1.0);
        vec![
            ("diffuse", 0.8, 0.0, Lobe::Brdf(brdf(BrdfKind::Lambert, phong), 1.0)),
            ("phong 20", 0.0, 0.8, Lobe::Brdf(brdf(BrdfKind::Phong, phong), 20.0)),
            ("phong 3 and diffuse", 0.4, 0.4, Lobe::Brdf(brdf(BrdfKind::Phong, phong), 3.0)),
            ("blinn 30", 0.2, 0.8, Lobe::Brdf(brdf(BrdfKind::Blinn, phong), 30.0)),
            ("lafortune", 0.0, 0.9, Lobe::Brdf(brdf(BrdfKind::Lafortune, V::new(0.9, 0.7, -0.8)), 8.0)),
            ("ward", 0.0, 0.7, Lobe::Brdf(brdf(BrdfKind::Ward, phong), 25.0)),
            ("ggx 0.3", 0.3, 0.5, Lobe::Ggx(0.3)),
            ("ggx 0.8", 0.0, 0.9, Lobe::Ggx(0.8)),
        ]
    }

    /// Views from straight above to near grazing.
    fn views() -> impl Iterator<Item = (f32, Vec3)> {
        let place = place();
        let (t, b) = sampling::frame(place.normal);
        [0.0, 0.5, 1.1, 1.4]
            .into_iter()
            .map(move |angle: f32| (angle, place.normal * angle.cos() + (t * 0.8 + b * 0.6) * angle.sin()))
    }

    /// The chi-square statistic of samples in cells of equal solid angle over all directions, against the density
    /// integrated over the cells; the failures to scatter are a cell of their own.
    #[test]
    fn directions_have_their_density() {
        const ROWS: usize = 20;
        const COLUMNS: usize = 40;
        const SAMPLES: u32 = 40_000;
        for (name, diffuse, glossy, lobe) in lobes() {
            for (angle, view) in views() {
                let place = place();
                let bsdf = Bsdf::new(&place, place.normal, view, parts(diffuse, glossy, lobe), &Rules::EXACT);
                let local = |d: Vec3| bsdf.to_local(d);
                let cell = |d: Vec3| {
                    let d = local(d);
                    let row = ((d.z * 0.5 + 0.5) * ROWS as f32).clamp(0.0, (ROWS - 1) as f32) as usize;
                    let column = ((d.y.atan2(d.x) / TAU + 0.5) * COLUMNS as f32) as usize;
                    row * COLUMNS + column.min(COLUMNS - 1)
                };
                let mut counts = vec![0.0_f64; ROWS * COLUMNS + 1];
                for i in 0..SAMPLES {
                    // Each from a pixel of its own: independent, as the statistic supposes.
                    let mut sampler = Sampler::new(77, i, 0);
                    let at = match bsdf.sample(sampler.next_1d(), sampler.next_2d()) {
                        Some(scattered) => cell(scattered.direction),
                        None => ROWS * COLUMNS,
                    };
                    counts[at] += 1.0;
                }
                let mut expected = vec![0.0_f64; ROWS * COLUMNS + 1];
                const FINE: usize = 24;
                for row in 0..ROWS * FINE {
                    for column in 0..COLUMNS * FINE {
                        let z = ((row as f32 + 0.5) / (ROWS * FINE) as f32) * 2.0 - 1.0;
                        let turn = (column as f32 + 0.5) / (COLUMNS * FINE) as f32 - 0.5;
                        let direction = bsdf.to_world(sampling::from_polar(z, turn));
                        let solid_angle = 4.0 * PI / (ROWS * COLUMNS * FINE * FINE) as f32;
                        let density = bsdf.evaluate(direction).1;
                        expected[(row / FINE) * COLUMNS + column / FINE] +=
                            f64::from(density * solid_angle) * f64::from(SAMPLES);
                    }
                }
                let sum: f64 = expected.iter().sum();
                expected[ROWS * COLUMNS] = (f64::from(SAMPLES) - sum).max(0.0);
                // Cells that expect few samples are pooled.
                let (mut statistic, mut freedom, mut pool) = (0.0, -1.0, (0.0, 0.0));
                for (count, expected) in counts.iter().zip(&expected) {
                    if *expected < 10.0 {
                        pool = (pool.0 + count, pool.1 + expected);
                    } else {
                        statistic += (count - expected).powi(2) / expected;
                        freedom += 1.0;
                    }
                }
                if pool.1 >= 10.0 {
                    statistic += (pool.0 - pool.1).powi(2) / pool.1;
                    freedom += 1.0;
                } else {
                    assert!(
                        pool.0 < pool.1 + 5.0 * pool.1.sqrt() + 10.0,
                        "{name} at {angle}: {pool:?} in cells of few"
                    );
                }
                // Wilson and Hilferty: the cube root of chi-square over its degrees of freedom is almost normal. 4.4 is a
                // probability of 5e-6 for one of the 32 cases.
                if freedom > 0.0 {
                    let v = 2.0 / (9.0 * freedom);
                    let z = ((statistic / freedom).cbrt() - (1.0 - v)) / f64::sqrt(v);
                    assert!(z < 4.4, "{name} at {angle}: chi-square {statistic:.0} for {freedom} degrees, z = {z:.1}");
                }
            }
        }
    }

    /// The mean weight of samples is the albedo: at most 1, and the same as the integral of the value.
    #[test]
    fn no_part_adds_energy() {
        for (name, diffuse, glossy, lobe) in lobes() {
            for (angle, view) in views() {
                let place = place();
                let bsdf = Bsdf::new(&place, place.normal, view, parts(diffuse, glossy, lobe), &Rules::EXACT);
                let count = 1 << 14;
                let mean = (0..count)
                    .map(|i| {
                        let mut sampler = Sampler::new(5, 0, i);
                        bsdf.sample(sampler.next_1d(), sampler.next_2d()).map_or(0.0, |s| f64::from(s.weight.x))
                    })
                    .sum::<f64>()
                    / f64::from(count);
                let (mut integral, rows, columns) = (0.0, 600, 600);
                for i in 0..rows * columns {
                    let z = ((i / columns) as f32 + 0.5) / rows as f32;
                    let turn = ((i % columns) as f32 + 0.5) / columns as f32;
                    let direction = bsdf.to_world(sampling::from_polar(z, turn));
                    integral += f64::from(bsdf.evaluate(direction).0.x) * f64::from(TAU) / f64::from(rows * columns);
                }
                assert!(mean <= 1.001, "{name} at {angle}: {mean}");
                // The midpoint rule over lobes of a few degrees, and the noise of 16,384 stratified samples.
                assert!((mean - integral).abs() < 0.01, "{name} at {angle}: {mean} by samples, {integral} by a grid");
            }
        }
    }
}
