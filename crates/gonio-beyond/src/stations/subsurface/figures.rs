//! The pictures: pawns on a table before a lamp.

use super::medium::{Dipole, TranslucentMedium, diffuse_reflectance, distance_inside, walk};
use super::pawn::{pawn, pawn_normal};
use super::surface_cache::{SETS, SurfaceCache};
use crate::camera::{Pinhole, Ray};
use crate::noise::{fractal, step};
use crate::random::{by_cosine, in_cone, sequence};
use crate::station::ImagePlane;
use glam::{DVec2, DVec3};
use gonio_bsdf::ParameterValues;
use gonio_bsdf::sampling::SplitMix;
use gonio_trace::Sampler;
use std::f64::consts::{PI, TAU};

/// How the light of a body is computed.
#[derive(Clone, Copy, Debug)]
pub enum LightModel {
    /// It leaves where it entered: a diffuse BRDF with the reflectance of a deep medium.
    Opaque,
    /// The diffusion approximation.
    Diffusion,
    /// Random walks.
    Walk,
}

struct Figure {
    place: DVec3,
    /// Extinction per height of the body and albedo of each channel.
    channels: [[f64; 2]; 3],
    reflectance: DVec3,
    model: LightModel,
    cache: SurfaceCache,
}

/// Pawns of height 1 on a table at y = 0.
pub struct Figures {
    figures: Vec<Figure>,
    camera: Pinhole,
    to_lamp: DVec3,
}

/// The place of the camera.
const EYE: DVec3 = DVec3::new(0.0, 1.25, 5.0);
/// The lamp: the cosine of the half angle under which it is seen, its radiance.
const LAMP_COS: f64 = 0.972;
const LAMP: DVec3 = DVec3::new(33.0, 30.0, 26.0);
const PRECISION: f64 = 2e-4;
/// Walks or probes from a vertex in each channel, for each set.
const WALKS: u32 = 18;
/// Samples of direct light, which are cheap.
const DIRECT: u32 = 4;
/// Boundaries turn radiance into a smooth surface's mirror image by this share at least (index 1.3).
const MIRRORED: f64 = 0.017;

impl Figures {
    /// Bodies with their places, and the values of the parameters.
    pub fn new(bodies: &[(DVec3, TranslucentMedium, LightModel)], values: &ParameterValues) -> Self {
        let height_mm = values.number("height");
        let angle = values.number("lamp").to_radians();
        let figure = |&(place, medium, model): &(DVec3, TranslucentMedium, LightModel)| {
            let of_channel = [0, 1, 2].map(|channel| medium.channel(channel));
            Figure {
                place,
                channels: of_channel.map(|[extinction, albedo]| [extinction * height_mm, albedo]),
                reflectance: DVec3::from_array(of_channel.map(|[_, albedo]| diffuse_reflectance(albedo))),
                model,
                cache: SurfaceCache::new(),
            }
        };
        Self {
            figures: bodies.iter().map(figure).collect(),
            camera: Pinhole::new(EYE, DVec3::new(0.0, 0.50, 0.0), 20.5),
            to_lamp: DVec3::new(0.75 * angle.sin(), 0.50, angle.cos()).normalize(),
        }
    }

    /// The first body on a ray, with the distance.
    fn body(&self, ray: &Ray) -> Option<(&Figure, f64)> {
        let met = |figure: &Figure| {
            let local = Ray { origin: ray.origin - figure.place, direction: ray.direction };
            let [enter, leave] = local.cylinder(DVec2::ZERO, 0.33)?;
            let (mut at, end) = (enter.max(0.0), leave);
            for _ in 0..160 {
                let free = pawn(local.at(at));
                if free < PRECISION {
                    return Some(at);
                }
                at += free;
                if at > end {
                    break;
                }
            }
            None
        };
        self.figures.iter().filter_map(|f| Some((f, met(f)?))).min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// The light of the room without the lamp.
    fn room(&self, direction: DVec3) -> DVec3 {
        let up = 0.5 + 0.5 * direction.y;
        let side = (direction.x * -0.7 + direction.z * 0.5).max(0.0).powi(3);
        DVec3::new(0.022, 0.032, 0.052) * (0.25 + up) + DVec3::new(0.11, 0.13, 0.17) * side
    }

    /// The lamp's light at a point without the cosine, from one direction towards it.
    fn lamp(&self, from: DVec3, random: &mut SplitMix) -> Option<DVec3> {
        let direction = in_cone(self.to_lamp, LAMP_COS, random);
        self.body(&Ray { origin: from, direction }).is_none().then_some(direction)
    }

    /// The irradiance of lamp and room.
    fn irradiance(&self, point: DVec3, normal: DVec3, random: &mut SplitMix) -> DVec3 {
        let from = point + normal * (4.0 * PRECISION);
        let mut light = DVec3::ZERO;
        if normal.dot(self.to_lamp) > -0.25
            && let Some(direction) = self.lamp(from, random)
        {
            light += LAMP * (TAU * (1.0 - LAMP_COS) * normal.dot(direction).max(0.0));
        }
        let direction = by_cosine(normal, random);
        if direction.y > 0.0 && self.body(&Ray { origin: from, direction }).is_none() {
            light += self.room(direction) * PI;
        }
        light
    }

    /// The radiance that leaves a body at a place of its surface, towards `out`.
    fn leaves(&self, figure: &Figure, point: DVec3, out: DVec3, samples: u32, random: &mut SplitMix) -> DVec3 {
        let local = point - figure.place;
        let normal = pawn_normal(local);
        match figure.model {
            LightModel::Opaque => {
                let light: DVec3 = (0..DIRECT).map(|_| self.irradiance(point, normal, random)).sum();
                figure.reflectance / PI * (light / f64::from(DIRECT))
            }
            LightModel::Diffusion => {
                let light: DVec3 = (0..samples).map(|_| self.by_diffusion(figure, local, normal, random)).sum();
                light / f64::from(samples)
            }
            LightModel::Walk => {
                let start = [local - normal * (3.0 * PRECISION), -out];
                let mut light = DVec3::ZERO;
                for _ in 0..samples {
                    // The same numbers in each channel: noise without colours.
                    let numbers = *random;
                    for channel in 0..3 {
                        *random = numbers;
                        light[channel] += self.by_walk(figure, start, channel, random) / f64::from(samples);
                    }
                }
                light
            }
        }
    }

    /// A walk against the light: at each event, the lamp's light that reaches it; where the walk leaves, that of the room.
    fn by_walk(&self, figure: &Figure, start: [DVec3; 2], channel: usize, random: &mut SplitMix) -> f64 {
        let [extinction, _] = figure.channels[channel];
        let mut light = 0.0;
        let share = LAMP[channel] * 0.5 * (1.0 - LAMP_COS);
        let exit = walk(&pawn, start, figure.channels[channel], PRECISION, random, |event, random| {
            // Deep inside almost nothing arrives: followed rarely, and then counted more.
            let chance = (-event.depth * extinction).exp();
            if random.next_number() >= chance {
                return;
            }
            let direction = in_cone(self.to_lamp, LAMP_COS, random);
            let reach = 12.0 / extinction;
            let passed = distance_inside(&pawn, event.point, direction, reach, PRECISION);
            let from = figure.place + event.point + direction * (passed + 8.0 * PRECISION);
            if passed < reach && self.body(&Ray { origin: from, direction }).is_none() {
                light += event.weight / chance * share * (-extinction * passed).exp();
            }
        });
        if let Some(exit) = exit {
            let from = figure.place + exit.point + exit.direction * (8.0 * PRECISION);
            let ray = Ray { origin: from, direction: exit.direction };
            if exit.direction.y > 0.0 && self.body(&ray).is_none() {
                light += exit.weight * self.room(exit.direction)[channel];
            } else if exit.direction.y < 0.0 {
                // The table, by its mean light.
                light += exit.weight * 0.08;
            }
        }
        light
    }

    /// The diffusion approximation: the irradiance at places around, found by probes along three axes, with the balance heuristic.
    /// Source: A. King et al., *BSSRDF Importance Sampling*, SIGGRAPH Talks 2013.
    fn by_diffusion(&self, figure: &Figure, point: DVec3, normal: DVec3, random: &mut SplitMix) -> DVec3 {
        let (u, v) = normal.any_orthonormal_pair();
        let axes = [(normal, 0.5), (u, 0.25), (v, 0.25)];
        let mut light = DVec3::ZERO;
        let numbers = *random;
        for channel in 0..3 {
            *random = numbers;
            let dipole = Dipole::new(figure.channels[channel]);
            let lengths = dipole.lengths();
            let choice = random.next_number();
            let axis = if choice < 0.5 {
                normal
            } else if choice < 0.75 {
                u
            } else {
                v
            };
            let length = lengths[usize::from(random.next_number() < 0.5)];
            let radius = -length * (1.0 - random.next_number()).ln();
            let turn = TAU * random.next_number();
            let (a, b) = axis.any_orthonormal_pair();
            let middle = point + (a * turn.cos() + b * turn.sin()) * radius;
            for place in crossings(middle, axis) {
                let there = pawn_normal(place);
                let density: f64 = axes
                    .iter()
                    .map(|(axis, chance)| {
                        let offset = place - point;
                        let r = (offset - *axis * offset.dot(*axis)).length().max(1e-9);
                        let radial = |s: f64| (-r / s).exp() / (TAU * s * r);
                        chance * 0.5 * (radial(lengths[0]) + radial(lengths[1])) * there.dot(*axis).abs()
                    })
                    .sum();
                let profile = dipole.profile((place - point).length());
                let arrives = self.irradiance(place + figure.place, there, random)[channel];
                light[channel] += profile * arrives / (PI * density);
            }
        }
        light
    }

    fn table(&self, point: DVec3, random: &mut SplitMix) -> DVec3 {
        let at = DVec2::new(point.x, point.z);
        let squares = (at * 1.15 + DVec2::new(0.5, 0.25)).floor();
        let is_light = (squares.x + squares.y).rem_euclid(2.0) < 0.5;
        let grain = fractal(DVec2::new(at.x * 3.0, at.y * 26.0) + squares * 7.3, 4, 210);
        let wood = if is_light { DVec3::new(0.36, 0.25, 0.15) } else { DVec3::new(0.085, 0.045, 0.028) };
        let albedo = wood * (0.6 + 0.7 * grain);
        let direct: DVec3 = (0..DIRECT).map(|_| self.irradiance(point, DVec3::Y, random)).sum();
        let mut light = direct / f64::from(DIRECT);
        // Light that comes out of the bodies.
        let direction = by_cosine(DVec3::Y, random);
        let ray = Ray { origin: point + DVec3::Y * 1e-3, direction };
        if let Some((figure, distance)) = self.body(&ray) {
            light += PI * self.leaves(figure, ray.at(distance), -direction, 1, random);
        }
        albedo / PI * light
    }

    fn surface(&self, figure: &Figure, point: DVec3, direction: DVec3, set: usize, random: &mut SplitMix) -> DVec3 {
        let normal = pawn_normal(point - figure.place);
        let cos = -direction.dot(normal);
        let mirrored = MIRRORED + (1.0 - MIRRORED) * (1.0 - cos.clamp(0.0, 1.0)).powi(5);
        let inside = if !matches!(figure.model, LightModel::Opaque) {
            figure.cache.light(point - figure.place, set, random, |vertex, random| {
                let vertex = figure.place + vertex;
                self.leaves(figure, vertex, (EYE - vertex).normalize(), WALKS, random)
            })
        } else {
            self.leaves(figure, point, -direction, 1, random)
        };
        // A polish that is not perfect: the lamp's image is blurred.
        let reflected = direction + normal * (2.0 * cos);
        let reflected = in_cone(reflected.normalize(), 0.996, random);
        let ray = Ray { origin: point + normal * (4.0 * PRECISION), direction: reflected };
        let outside = if reflected.y < 0.0 || self.body(&ray).is_some() {
            DVec3::splat(0.03)
        } else {
            let lamp = step(LAMP_COS - 0.012, LAMP_COS, reflected.dot(self.to_lamp));
            self.room(reflected) + LAMP * lamp
        };
        inside.lerp(outside, mirrored)
    }
}

/// The places where the line along `axis` meets the surface.
fn crossings(middle: DVec3, axis: DVec3) -> Vec<DVec3> {
    const REACH: f64 = 1.3;
    let mut found = Vec::new();
    let mut at = -REACH;
    let mut is_inside = false;
    while at < REACH {
        let place = middle + axis * at;
        let distance = pawn(place);
        if (distance < 0.0) != is_inside {
            is_inside = !is_inside;
            found.push(place);
        }
        at += distance.abs().max(5e-4);
    }
    found
}

impl ImagePlane for Figures {
    fn light(&self, at: DVec2, sampler: &mut Sampler) -> DVec3 {
        // The samples of a pixel take every set of walks in turn, all pixels the same one: the first samples need few walks.
        let set = sampler.index() as usize % SETS;
        let random = &mut sequence(sampler);
        let ray = self.camera.ray(at);
        let ground = ray.plane(DVec3::ZERO, DVec3::Y);
        if let Some((figure, distance)) = self.body(&ray)
            && ground.is_none_or(|ground| distance < ground)
        {
            return self.surface(figure, ray.at(distance), ray.direction, set, random);
        }
        let far = DVec3::new(0.010, 0.013, 0.022);
        ground.map_or(far, |distance| {
            let point = ray.at(distance);
            self.table(point, random).lerp(far, step(-0.5, -9.0, point.z))
        })
    }
}
