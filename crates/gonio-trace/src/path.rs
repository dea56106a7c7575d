//! One path of light, followed from the eye.
//!
//! At each place the light of one source that is sampled there, and the light that the next direction happens to find,
//! are added with the weights of multiple importance sampling. Long paths end by Russian roulette.

use crate::bsdf::{Bsdf, Scattering};
use crate::color::{ColorMode, Tint, Wavelengths};
use crate::geometry::{Geometry, Place};
use crate::lights::{LightSample, Lights, Strength};
use crate::material::Materials;
use crate::sampler::Sampler;
use crate::sampling::power_heuristic;
use crate::tree::Ray;
use crate::{Simplification, Simplifications};
use glam::{Vec2, Vec3, Vec4};

/// Which samples of light count: all are estimates of the same picture, with other noise.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Technique {
    /// Lights and directions, weighted by how likely each was to find the light (E. Veach, 1997).
    #[default]
    Both,
    /// Lights are sampled. What no sample of a light can find (mirrors, glass) is found by directions.
    Lights,
    /// Only directions: light that has no size is never found.
    Directions,
}

/// Everything that a path reads.
pub(crate) struct World<'s> {
    pub geometry: &'s Geometry,
    pub materials: Materials<'s>,
    pub lights: &'s Lights,
    pub technique: Technique,
    pub simplified: Simplifications,
    /// Surfaces that a path meets, at most; 1: only emitted light is seen.
    pub most_depth: u32,
}

/// What a path found.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Found {
    pub light: Vec4,
    /// Whether any surface was hit; holes do not count.
    pub hit: bool,
}

/// Paths of this many surfaces or more may end by Russian roulette.
const ROULETTE_FROM: u32 = 3;
/// Holes and transparent surfaces in a row that count, at most: a bound, not a limit that scenes meet.
const MOST_HOLES: u32 = 256;

impl World<'_> {
    /// The light that comes along a ray from the eye.
    pub fn follow(&self, mut ray: Ray, sampler: &mut Sampler, wavelengths: &mut Wavelengths) -> Found {
        let mut found = Found { light: Vec4::ZERO, hit: false };
        let mut throughput = Vec4::ONE;
        // The density of the last direction; none for single directions, which no sample of a light finds.
        let mut last: Option<f32> = None;
        let mut medium: Option<u32> = None;
        let mut holes = 0;
        let mut travelled = 0.0;
        // Product of the squared ratios of indices: not a loss, so roulette must not count it as one.
        let mut refraction_scale = 1.0_f32;
        let mut depth = 0;
        while depth < self.most_depth {
            let Some(hit) = self.geometry.tree.nearest(&ray) else {
                self.add_environment(&mut found, throughput, ray.direction, last, wavelengths);
                break;
            };
            let place = self.geometry.place(self.materials.scene, &hit);
            let triangle = &self.geometry.triangles[hit.triangle as usize];
            let view = -ray.direction;
            travelled += hit.distance;
            // Inside of a body, known from where the path went in, or (the eye inside) from the back that it sees.
            let inside = medium.or_else(|| {
                (place.geometric_normal.dot(view) < 0.0 && self.materials.is_clear(triangle.material))
                    .then_some(triangle.material)
            });
            if let Some(body) = inside {
                let way = f64::from(hit.distance) / self.geometry.space.scale;
                let absorption = self.materials.absorption(body, wavelengths);
                throughput *= (absorption * -(way as f32)).map(f32::exp);
            }
            if let Some(source) = triangle.light {
                let cos = place.geometric_normal.dot(view).abs();
                let density = self.lights.triangle_density(source, travelled, cos);
                let weight = self.weight_of_direction(last, density);
                let opacity = self.materials.opacity(triangle.material, place.uv);
                let emitted = self.materials.emitted(triangle.material, place.uv);
                found.light += throughput * self.materials.mode.light(&emitted, wavelengths) * (weight * opacity);
            }
            let normal = self.materials.normal(triangle.material, &place);
            let parts = self.materials.parts(triangle.material, &place, normal, view, wavelengths);
            let bsdf = Bsdf::new(&place, normal, view, parts);
            let choice = sampler.next_2d();
            let Some(next) = bsdf.sample(choice.x, sampler.next_2d()) else {
                found.hit = true;
                if bsdf.is_rough() && depth + 1 < self.most_depth {
                    let direct = self.direct(&place, &bsdf, choice.y, sampler, wavelengths);
                    found.light += throughput * direct / bsdf.probability_of_surface();
                }
                break;
            };
            if next.kind == Scattering::Straight {
                holes += 1;
                if holes > MOST_HOLES {
                    break;
                }
                throughput *= next.weight;
                // The place of the light sample stays the last one that scattered, and so does `travelled`.
                ray = Ray { origin: place.leave(ray.direction), direction: ray.direction, reach: f32::INFINITY };
                continue;
            }
            found.hit = true;
            depth += 1;
            if bsdf.is_rough() && depth < self.most_depth {
                let direct = self.direct(&place, &bsdf, choice.y, sampler, wavelengths);
                found.light += throughput * direct / bsdf.probability_of_surface();
            }
            throughput *= next.weight;
            if next.kind == Scattering::Refracted {
                let entering = place.geometric_normal.dot(next.direction) < 0.0;
                medium = entering.then_some(triangle.material);
                refraction_scale *= next.weight.max_element().max(1e-6);
            }
            travelled = 0.0;
            last = next.density.is_finite().then_some(next.density);
            ray = Ray { origin: place.leave(next.direction), direction: next.direction, reach: f32::INFINITY };
            let survival = throughput.max_element() / refraction_scale;
            if survival.is_nan() || survival <= 0.0 {
                break;
            }
            if depth >= ROULETTE_FROM && survival < 1.0 {
                let keep = survival.max(0.05);
                if sampler.next_1d() >= keep {
                    break;
                }
                throughput /= keep;
            }
        }
        found
    }

    /// The share of light found by a direction of density `last` that counts, where light samples have `density`.
    fn weight_of_direction(&self, last: Option<f32>, density: f32) -> f32 {
        match (last, self.technique) {
            (None, _) | (_, Technique::Directions) => 1.0,
            (Some(_), Technique::Lights) => 0.0,
            (Some(last), Technique::Both) => power_heuristic(last, density),
        }
    }

    fn add_environment(
        &self,
        found: &mut Found,
        throughput: Vec4,
        direction: Vec3,
        last: Option<f32>,
        wavelengths: &Wavelengths,
    ) {
        // The eye's own rays show the background, which is not always the environment.
        if let Some(environment) = self.lights.environment.as_ref().filter(|_| found.hit) {
            let weight = self.weight_of_direction(last, self.lights.environment_density(direction));
            let radiance = Tint::of_light(environment.radiance(direction));
            found.light += throughput * self.materials.mode.light(&radiance, wavelengths) * weight;
        }
    }

    /// Light of one sampled source that the place scatters to the view.
    fn direct(
        &self,
        place: &Place,
        bsdf: &Bsdf,
        choice: f32,
        sampler: &mut Sampler,
        wavelengths: &Wavelengths,
    ) -> Vec4 {
        let u = sampler.next_2d();
        if self.technique == Technique::Directions {
            return Vec4::ZERO;
        }
        let Some(sample) = self.lights.sample(self.geometry, place.position, choice, u) else { return Vec4::ZERO };
        let (value, density) = bsdf.evaluate(sample.direction);
        if value == Vec4::ZERO {
            return Vec4::ZERO;
        }
        let clear_way = self.clear_way(place, &sample);
        if clear_way <= 0.0 {
            return Vec4::ZERO;
        }
        let (tint, strength) = match sample.light {
            Strength::Irradiance(tint, factor) => (tint, factor / sample.probability),
            Strength::Radiance(radiance) => (Tint::of_light(radiance), 1.0 / sample.density),
            Strength::Emitted(triangle, weights) => {
                let (tint, opacity) = self.emitted_at(triangle, weights);
                (tint, opacity / sample.density)
            }
        };
        let weight = match (sample.density.is_infinite(), self.technique) {
            (false, Technique::Both) => power_heuristic(sample.density, density),
            _ => 1.0,
        };
        value * self.materials.mode.light(&tint, wavelengths) * (strength * weight * clear_way)
    }

    /// The radiance of a place of a lamp, and its opacity.
    fn emitted_at(&self, triangle: u32, weights: Vec3) -> (Tint, f32) {
        let material = self.geometry.triangles[triangle as usize].material;
        if self.materials.emits_evenly(material) {
            return (self.materials.emitted(material, Vec2::ZERO), 1.0);
        }
        let hit = crate::tree::Hit { distance: 0.0, triangle, barycentrics: weights };
        let place = self.geometry.place(self.materials.scene, &hit);
        (self.materials.emitted(material, place.uv), self.materials.opacity(material, place.uv))
    }

    /// The share of light that arrives from a sampled source: 0 behind an opaque surface.
    fn clear_way(&self, place: &Place, sample: &LightSample) -> f32 {
        if self.simplified.contains(Simplification::Shadows) {
            return 1.0;
        }
        let mut origin = place.leave(sample.direction);
        let mut share = 1.0;
        for _ in 0..MOST_HOLES {
            let (direction, reach) = match sample.end {
                Some(end) => {
                    let way = end - origin;
                    let distance = way.length();
                    // A light closer than rounding can tell is not blocked.
                    if distance <= 0.0 {
                        return share;
                    }
                    (way / distance, distance * (1.0 - 4.0 * f32::EPSILON))
                }
                None => (sample.direction, f32::INFINITY),
            };
            let ray = Ray { origin, direction, reach };
            if !self.materials.has_holes {
                return if self.geometry.tree.is_blocked(&ray) { 0.0 } else { share };
            }
            let Some(hit) = self.geometry.tree.nearest(&ray) else { return share };
            let between = self.geometry.place(self.materials.scene, &hit);
            let material = self.geometry.triangles[hit.triangle as usize].material;
            share *= 1.0 - self.materials.opacity(material, between.uv);
            if share <= 0.0 {
                return 0.0;
            }
            origin = between.leave(direction);
        }
        0.0
    }
}

impl ColorMode {
    /// The wavelengths of a path.
    pub(crate) fn wavelengths(self, sampler: &mut Sampler) -> Wavelengths {
        match self {
            ColorMode::Spectral => Wavelengths::sample(sampler.next_1d()),
            ColorMode::Rgb => Wavelengths::NONE,
        }
    }
}
