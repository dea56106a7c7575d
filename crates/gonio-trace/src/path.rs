//! One path of light, followed from the eye or from a surface.
//!
//! At each place the light of one source that is sampled there, and the light that the next direction happens to find,
//! are added with the weights of multiple importance sampling. Long paths end by Russian roulette.

use crate::bsdf::{Bsdf, Scattered, Scattering};
use crate::choice::Vantage;
use crate::color::Tint;
use crate::diffuse::{Diffuse, Scatter};
use crate::eye::Eye;
use crate::geometry::{Geometry, Place};
use crate::lamps::LightRules;
use crate::lights::{LightOrigin, LightSample, Lights, Strength};
use crate::material::Materials;
use crate::own_brdf::OwnBrdf;
use crate::rules::Rules;
use crate::sampler::Sampler;
use crate::sampling::power_heuristic;
use crate::tree::{Hit, Ray};
use crate::wavelengths::Wavelengths;
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
    /// [`Technique::Lights`] where a direction cannot find all light that counts: without shadows it would find only
    /// the nearest source, and points are never found.
    pub technique: Technique,
    pub simplified: Simplifications,
    pub eye: Eye,
    pub rules: Rules,
    pub light_rules: LightRules,
    /// Directions find the environment, although they find nothing else: nothing blocks it.
    pub finds_environment: bool,
    /// Surfaces that a path meets, at most; 1: only emitted light is seen.
    pub most_depth: u32,
}

/// Takes note of the light that a path finds.
pub(crate) trait Recorder {
    /// Light that was scattered this many times, from the source `origin`.
    fn add(&mut self, scatterings: u32, origin: LightOrigin, light: Vec4);
}

impl Recorder for () {
    #[inline]
    fn add(&mut self, _: u32, _: LightOrigin, _: Vec4) {}
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

/// Point lights that are added up at the first surface, at most; of more, one is chosen.
const MOST_SUMMED: usize = 1024;

/// A path, as far as it has been followed.
struct Path {
    /// The way to the next surface.
    ray: Ray,
    throughput: Vec4,
    found: Found,
    /// The density of the last direction; none for single directions, which no sample of a light finds.
    last: Option<f32>,
    /// Where that direction was chosen.
    from: Vantage,
    travelled: f32,
    /// Only light sources count on this part of the way.
    to_sources: bool,
    medium: Option<u32>,
    /// Product of the squared ratios of indices: not a loss, so roulette must not count it as one.
    refraction_scale: f32,
    /// Surfaces that scattered it.
    depth: u32,
}

impl Path {
    fn new(ray: Ray) -> Self {
        Path {
            ray,
            throughput: Vec4::ONE,
            found: Found { light: Vec4::ZERO, hit: false },
            last: None,
            from: Vantage::open(ray.origin),
            travelled: 0.0,
            to_sources: false,
            medium: None,
            refraction_scale: 1.0,
            depth: 0,
        }
    }
}

impl World<'_> {
    /// The light that comes along a ray from the eye.
    pub fn follow(
        &self,
        ray: Ray,
        sampler: &mut Sampler,
        wavelengths: &mut Wavelengths,
        recorder: &mut impl Recorder,
    ) -> Found {
        self.complete(Path::new(ray), sampler, wavelengths, recorder)
    }

    /// The light that a white, diffuse surface at `place` scatters, in the place of what is there. It is lit on the side of its
    /// interpolated normal.
    pub fn follow_from_white(&self, place: &Place, sampler: &mut Sampler, wavelengths: &mut Wavelengths) -> Vec4 {
        let white = Scatter::Diffuse(Diffuse::new(place, place.normal, Vec4::ONE));
        let choice = sampler.next_2d();
        let next = white.sample(choice.x, sampler.next_2d());
        let mut path = Path::new(Ray { origin: place.position, direction: -place.normal, reach: f32::INFINITY });
        if !self.scatter_at(&mut path, place, None, &white, choice.y, next, sampler, wavelengths, &mut ()) {
            return path.found.light;
        }
        self.complete(path, sampler, wavelengths, &mut ()).light
    }

    /// Follows a path to its end.
    #[inline]
    fn complete(
        &self,
        mut path: Path,
        sampler: &mut Sampler,
        wavelengths: &mut Wavelengths,
        recorder: &mut impl Recorder,
    ) -> Found {
        let mut holes = 0;
        let exact = self.rules.are_exact();
        let unblocked = self.simplified.contains(Simplification::Shadows);
        while path.depth < self.most_depth {
            let ray = path.ray;
            let hit = self.geometry.tree.nearest(&ray);
            if !self.lights.lamps.is_empty() && (path.last.is_none() || !unblocked) {
                let reach = hit.as_ref().map_or(ray.reach, |hit| hit.distance);
                if let Some((lamp, distance, shines)) = self.lights.nearest_lamp(&Ray { reach, ..ray }) {
                    path.found.hit = true;
                    if let Some(body) = path.medium {
                        path.throughput *= self.transmittance(body, distance, wavelengths);
                    }
                    if shines {
                        let way = path.travelled + distance;
                        let seen = self.seen_lamp(lamp, &path.from, ray.direction, way, path.last, wavelengths);
                        let light = seen * path.throughput;
                        path.found.light += light;
                        recorder.add(path.depth, self.lights.origins[self.lights.lamps[lamp].1], light);
                    }
                    break;
                }
            }
            let Some(hit) = hit else {
                // The eye's own rays show the background, which is not always the environment.
                if path.found.hit {
                    let weight = |density| self.weight_of_direction(path.last, density);
                    let arriving = self.environment_light(&path.from, ray.direction, weight, wavelengths);
                    let light = path.throughput * arriving;
                    path.found.light += light;
                    recorder.add(path.depth, LightOrigin::Environment, light);
                }
                break;
            };
            let place = self.geometry.place(self.materials.scene, &hit);
            let triangle = &self.geometry.triangles[hit.triangle as usize];
            let view = -ray.direction;
            path.travelled += hit.distance;
            // Inside of a body, known from where the path went in, or (the eye inside) from the back that it sees.
            let inside = path.medium.or_else(|| {
                (place.geometric_normal.dot(view) < 0.0 && self.materials.is_clear(triangle.material))
                    .then_some(triangle.material)
            });
            if let Some(body) = inside {
                path.throughput *= self.transmittance(body, hit.distance, wavelengths);
            }
            if let Some(source) = triangle.light {
                let weight = match (path.last, self.technique) {
                    (None, _) | (_, Technique::Directions) => 1.0,
                    (Some(_), Technique::Lights) => 0.0,
                    (Some(_), Technique::Both) => {
                        let cos = place.geometric_normal.dot(view).abs();
                        let rules = &self.light_rules;
                        let density = self.lights.triangle_density(rules, source, &path.from, path.travelled, cos);
                        self.weight_of_direction(path.last, density)
                    }
                };
                if weight > 0.0 && self.materials.emits {
                    let opacity = self.materials.opacity(triangle.material, place.uv);
                    let emitted = self.materials.emitted(triangle, place.uv);
                    let light = path.throughput * self.materials.mode.light(&emitted, wavelengths) * (weight * opacity);
                    path.found.light += light;
                    recorder.add(path.depth, LightOrigin::Object(triangle.object as usize), light);
                }
            }
            if path.to_sources {
                // What a hole lets through.
                path.throughput *= 1.0 - self.materials.opacity(triangle.material, place.uv);
                holes += 1;
                if path.throughput == Vec4::ZERO || holes > MOST_HOLES {
                    break;
                }
                path.ray = Ray { origin: place.leave(ray.direction), direction: ray.direction, reach: f32::INFINITY };
                continue;
            }
            let only_diffuse =
                if exact { self.materials.only_diffuse(triangle.material, &place, wavelengths) } else { None };
            let bsdf = match only_diffuse {
                Some(color) => Scatter::Diffuse(Diffuse::new(&place, view, color)),
                None => self.scatter(triangle.material, &place, view, wavelengths),
            };
            if let Some(term) = &self.materials.ambient {
                let ambient = self.materials.ambient(term, triangle.material, &place, wavelengths);
                let light = ambient * bsdf.lit() * path.throughput;
                path.found.light += light;
                recorder.add(path.depth + 1, LightOrigin::Ambient, light);
            }
            let choice = sampler.next_2d();
            let next = bsdf.sample(choice.x, sampler.next_2d());
            if let Some(next) = next.as_ref().filter(|next| next.kind == Scattering::Straight) {
                holes += 1;
                if holes > MOST_HOLES {
                    break;
                }
                path.throughput *= next.weight;
                // The place of the light sample stays the last one that scattered, and so does `travelled`.
                path.ray = Ray { origin: place.leave(ray.direction), direction: ray.direction, reach: f32::INFINITY };
                continue;
            }
            let body = Some(triangle.material);
            if !self.scatter_at(&mut path, &place, body, &bsdf, choice.y, next, sampler, wavelengths, recorder) {
                break;
            }
        }
        path.found
    }

    /// Adds the light that a surface scatters along a path, and sends the path on in the direction `next`. `body` is what
    /// refracted light enters there; `choice`, in `[0, 1)`, chooses the light. Returns whether the path goes on.
    #[allow(clippy::too_many_arguments)]
    #[inline(always)]
    fn scatter_at(
        &self,
        path: &mut Path,
        place: &Place,
        body: Option<u32>,
        bsdf: &Scatter,
        choice: f32,
        next: Option<Scattered>,
        sampler: &mut Sampler,
        wavelengths: &mut Wavelengths,
        recorder: &mut impl Recorder,
    ) -> bool {
        let view = -path.ray.direction;
        path.found.hit = true;
        path.depth += 1;
        let depth = path.depth;
        let is_one_sided = self.rules.are_exact() && !bsdf.is_lit_behind();
        let vantage = if is_one_sided { Vantage::of(place, view) } else { Vantage::open(place.position) };
        if bsdf.is_rough() && depth < self.most_depth {
            let share = path.throughput / bsdf.probability_of_surface();
            if depth == 1 && self.sums() {
                self.add_all(&mut path.found, place, bsdf, share, wavelengths, recorder);
            } else if self.technique != Technique::Directions {
                let u = sampler.next_2d();
                let sample = self.lights.sample(self.geometry, &self.light_rules, &vantage, choice, u);
                self.add_direct(&mut path.found, place, bsdf, sample, share, depth, wavelengths, recorder);
            } else {
                sampler.next_2d();
            }
        }
        let Some(next) = next else { return false };
        path.throughput *= next.weight;
        path.last = next.density.is_finite().then_some(next.density);
        if let Some(density) = path.last {
            if self.finds_environment && depth < self.most_depth {
                let weight = |light_density| power_heuristic(density, light_density);
                let arriving = self.environment_light(&vantage, next.direction, weight, wavelengths);
                let light = path.throughput * arriving;
                path.found.light += light;
                recorder.add(depth, LightOrigin::Environment, light);
            }
            if bsdf.is_behind(next.direction) {
                return false;
            }
        }
        if next.kind == Scattering::Refracted {
            let entering = place.geometric_normal.dot(next.direction) < 0.0;
            path.medium = body.filter(|_| entering);
            path.refraction_scale *= next.weight.max_element().max(1e-6);
        }
        if self.simplified.contains(Simplification::Interreflection) {
            // Light on its way through a body does not come from another surface.
            path.to_sources = path.medium.is_none();
            if path.to_sources && path.last.is_some() && self.technique == Technique::Lights {
                return false;
            }
        }
        path.travelled = 0.0;
        path.from = vantage;
        path.ray = Ray { origin: place.leave(next.direction), direction: next.direction, reach: f32::INFINITY };
        let survival = path.throughput.max_element() / path.refraction_scale;
        if survival.is_nan() || survival <= 0.0 {
            return false;
        }
        if depth >= ROULETTE_FROM && survival < 1.0 {
            let keep = survival.max(0.05);
            if sampler.next_1d() >= keep {
                return false;
            }
            path.throughput /= keep;
        }
        true
    }

    /// How a surface of any material scatters light.
    #[inline(never)]
    fn scatter(&self, material: u32, place: &Place, view: Vec3, wavelengths: &mut Wavelengths) -> Scatter<'_> {
        let normal = self.materials.normal(material, place);
        if let Some(brdf) = self.materials.own_brdf(material) {
            let opacity = self.materials.opacity(material, place.uv);
            let lanes = (self.materials.mode, &*wavelengths);
            return Scatter::Own(OwnBrdf::new(brdf, place, normal, view, opacity, &self.rules, lanes));
        }
        let parts = self.materials.parts(material, place, normal, view, wavelengths);
        Scatter::Any(Bsdf::new(place, normal, view, parts, &self.rules))
    }

    /// Whether all sources are added up.
    fn sums(&self) -> bool {
        self.simplified.contains(Simplification::Sum) && self.lights.sources.len() <= MOST_SUMMED
    }

    /// The share of light that a body lets through along a way in trace space.
    fn transmittance(&self, body: u32, distance: f32, wavelengths: &Wavelengths) -> Vec4 {
        let way = f64::from(distance) / self.geometry.space.scale;
        (self.materials.absorption(body, wavelengths) * -(way as f32)).map(f32::exp)
    }

    /// The light of a lamp that a direction from `from` found at `distance`.
    fn seen_lamp(
        &self,
        lamp: usize,
        from: &Vantage,
        direction: Vec3,
        distance: f32,
        last: Option<f32>,
        wavelengths: &Wavelengths,
    ) -> Vec4 {
        // Light that is seen, in a mirror too, does not fall with the distance.
        let strength = self.lights.lamps[lamp].0.strength(&self.light_rules, direction, last.map(|_| distance));
        let density = || self.lights.lamp_density(&self.light_rules, lamp, from, direction, distance);
        let weight = last.map_or(1.0, |_| self.weight_of_direction(last, density()));
        self.materials.mode.light(&self.lights.lamps[lamp].0.radiance, wavelengths) * (strength * weight)
    }

    /// The share of light found by a direction of density `last` that counts, where light samples have `density`.
    fn weight_of_direction(&self, last: Option<f32>, density: f32) -> f32 {
        match (last, self.technique) {
            (None, _) | (_, Technique::Directions) => 1.0,
            (Some(_), Technique::Lights) => 0.0,
            (Some(last), Technique::Both) => power_heuristic(last, density),
        }
    }

    /// Light of the environment; `weight` of the density with which light samples find the direction.
    fn environment_light(
        &self,
        from: &Vantage,
        direction: Vec3,
        weight: impl Fn(f32) -> f32,
        wavelengths: &Wavelengths,
    ) -> Vec4 {
        let Some(environment) = &self.lights.environment else { return Vec4::ZERO };
        let weight = weight(self.lights.environment_density(&self.light_rules, from, direction));
        if weight == 0.0 {
            return Vec4::ZERO;
        }
        let radiance = Tint::of_light(environment.radiance(direction));
        self.materials.mode.light(&radiance, wavelengths) * weight
    }

    /// Adds the light of all sources, each at its middle, that the first surface scatters to the eye.
    #[inline(never)]
    fn add_all(
        &self,
        found: &mut Found,
        place: &Place,
        bsdf: &Scatter,
        throughput: Vec4,
        wavelengths: &Wavelengths,
        recorder: &mut impl Recorder,
    ) {
        for source in 0..self.lights.sources.len() {
            let u = Vec2::splat(0.5);
            let sample = self.lights.sample_source(source, 1.0, self.geometry, &self.light_rules, place.position, u);
            self.add_direct(found, place, bsdf, sample, throughput, 1, wavelengths, recorder);
        }
    }

    /// Adds the light of one sample that the place scatters to the view.
    #[allow(clippy::too_many_arguments)]
    #[inline]
    fn add_direct(
        &self,
        found: &mut Found,
        place: &Place,
        bsdf: &Scatter,
        sample: Option<LightSample>,
        throughput: Vec4,
        depth: u32,
        wavelengths: &Wavelengths,
        recorder: &mut impl Recorder,
    ) {
        let Some(sample) = sample else { return };
        let light = throughput * self.direct(place, bsdf, &sample, wavelengths);
        found.light += light;
        recorder.add(depth, self.lights.origins[sample.source], light);
    }

    /// Light of a sample that the place scatters to the view.
    #[inline]
    fn direct(&self, place: &Place, bsdf: &Scatter, sample: &LightSample, wavelengths: &Wavelengths) -> Vec4 {
        let (value, density) = bsdf.evaluate(sample.direction);
        if value == Vec4::ZERO {
            return Vec4::ZERO;
        }
        let clear_way = self.clear_way(place, sample);
        if clear_way <= 0.0 {
            return Vec4::ZERO;
        }
        let (tint, strength) = match sample.light {
            Strength::Irradiance(tint, factor) => (tint, factor / sample.probability),
            Strength::Radiance(tint, factor) => (tint, factor / sample.density),
            Strength::Emitted(triangle, weights) => {
                let (tint, opacity) = self.emitted_at(triangle, weights);
                (tint, opacity / sample.density)
            }
        };
        let also_found = self.technique == Technique::Both && !self.is_only_sampled(sample)
            || self.finds_environment && self.lights.origins[sample.source] == LightOrigin::Environment;
        let weight =
            if also_found && sample.density.is_finite() { power_heuristic(sample.density, density) } else { 1.0 };
        value * self.materials.mode.light(&tint, wavelengths) * (strength * weight * clear_way)
    }

    /// Whether directions count for nothing that find this light.
    #[inline]
    fn is_only_sampled(&self, sample: &LightSample) -> bool {
        matches!(sample.light, Strength::Emitted(triangle, _) if self.lights.overlaps(triangle))
    }

    /// The radiance of a place of a lamp, and its opacity.
    fn emitted_at(&self, triangle: u32, weights: Vec3) -> (Tint, f32) {
        let of = &self.geometry.triangles[triangle as usize];
        if self.materials.emits_evenly(of.material) {
            return (self.materials.emitted(of, Vec2::ZERO), 1.0);
        }
        let hit = Hit { distance: 0.0, triangle, barycentrics: weights };
        let place = self.geometry.place(self.materials.scene, &hit);
        (self.materials.emitted(of, place.uv), self.materials.opacity(of.material, place.uv))
    }

    /// The share of light that arrives from a sampled source: 0 behind an opaque surface.
    #[inline]
    fn clear_way(&self, place: &Place, sample: &LightSample) -> f32 {
        if self.simplified.contains(Simplification::Shadows) {
            return 1.0;
        }
        let origin = place.leave(sample.direction);
        let is_simple = !self.materials.has_holes && self.lights.lamps.is_empty() && self.lights.overlapping.is_empty();
        if !is_simple || self.simplified.contains(Simplification::Sum) {
            return self.clear_way_through(origin, sample);
        }
        let ray = match sample.end {
            // The way is the unit of length. A light closer than rounding can tell is not blocked.
            Some(end) => Ray { origin, direction: end - origin, reach: 1.0 - 4.0 * f32::EPSILON },
            None => Ray { origin, direction: sample.direction, reach: f32::INFINITY },
        };
        if ray.direction != Vec3::ZERO && self.geometry.tree.is_blocked(&ray) { 0.0 } else { 1.0 }
    }

    /// [`Self::clear_way`] where holes let light through, and lamps and objects may be in the way.
    #[inline(never)]
    fn clear_way_through(&self, mut origin: Vec3, sample: &LightSample) -> f32 {
        let mut share = 1.0;
        // A point that stands for an object is not in its shadow.
        let own = match self.lights.origins[sample.source] {
            LightOrigin::Object(object) if self.simplified.contains(Simplification::Sum) => Some(object as u32),
            _ => None,
        };
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
            if self.lights.lamps_block(&ray, sample) {
                return 0.0;
            }
            let is_simple = !self.materials.has_holes && own.is_none();
            let hit = if is_simple { None } else { self.geometry.tree.nearest(&ray) };
            let Some(hit) = hit else {
                let blocked = is_simple && self.geometry.tree.is_blocked(&ray);
                let covered = || self.lights.is_covered(self.geometry, &ray, sample);
                return if blocked || covered() { 0.0 } else { share };
            };
            let between = self.geometry.place(self.materials.scene, &hit);
            let triangle = &self.geometry.triangles[hit.triangle as usize];
            if own != Some(triangle.object) {
                share *= 1.0 - self.materials.opacity(triangle.material, between.uv);
            }
            if share <= 0.0 {
                return 0.0;
            }
            origin = between.leave(direction);
        }
        0.0
    }
}
