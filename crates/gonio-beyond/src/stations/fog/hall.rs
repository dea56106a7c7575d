//! The picture: a hall at night with fog, a spotlight and a fire.

use super::air::{FLAME, FLAME_HEIGHT, FLAME_MAJORANT, FLAME_SOURCES, Fog, flame, flame_interval};
use super::tracking::{delta_track, phase, ratio_track, scatter};
use crate::camera::{Pinhole, Ray};
use crate::noise::{fractal, step};
use crate::random::{by_cosine, sequence};
use crate::station::ImagePlane;
use glam::{DVec2, DVec3};
use gonio_bsdf::sampling::SplitMix;
use gonio_trace::Sampler;
use std::f64::consts::PI;

/// The hall.
pub struct Hall {
    fog: Fog,
    camera: Pinhole,
    /// Towards where the lamp points, to its right, upwards.
    lamp_axes: [DVec3; 3],
}

/// The lamp's lens, the place at which it points, its radius in m and its intensity.
const LAMP: DVec3 = DVec3::new(-2.75, 3.75, -0.55);
const AIM: DVec3 = DVec3::new(0.95, 1.05, -0.95);
const LENS: f64 = 0.07;
const INTENSITY: DVec3 = DVec3::new(150.0, 146.0, 138.0);
/// Light scattered several times next to a lamp would be noise: there the lamp counts as this large, in m.
const BLUR: f64 = 0.6;
/// The tangent of half the cone's angle.
const CONE: f64 = 0.27;
/// A ball on a pillar.
const BALL: DVec3 = DVec3::new(0.95, 1.38, -0.95);
const BALL_RADIUS: f64 = 0.50;
/// Upright cylinders: x, z, radius, top.
const CYLINDERS: [[f64; 4]; 5] = [
    [0.95, -0.95, 0.27, 0.90],
    [-2.35, -2.35, 0.34, 9.0],
    [2.55, -2.35, 0.34, 9.0],
    [0.10, -3.35, 0.34, 9.0],
    [-1.62, 0.55, 0.24, 0.88],
];
const WALL: f64 = -4.1;
const FAR: f64 = 40.0;
/// Points of single scattering along a ray, and events of a path at most.
const POINTS: u32 = 4;
const EVENTS: u32 = 5;

/// Paths of light scattered several times for a sample, and the most light of each, which the picture loses above it.
const PATHS: u32 = 2;
const LIMIT: f64 = 0.12;

/// A surface: the distance, the normal, the share of light that it reflects.
#[derive(Clone, Copy)]
struct Surface {
    distance: f64,
    normal: DVec3,
    albedo: DVec3,
}

impl Hall {
    /// The hall with fog.
    pub fn new(fog: Fog) -> Self {
        let ahead = (AIM - LAMP).normalize();
        let right = ahead.cross(DVec3::Y).normalize();
        Self {
            fog,
            camera: Pinhole::new(DVec3::new(0.15, 1.55, 6.6), DVec3::new(-0.1, 1.72, -1.0), 36.0),
            lamp_axes: [ahead, right, right.cross(ahead)],
        }
    }

    /// The transmittance of the fog, and of the flame, along a ray: an estimate.
    fn transmittance(&self, ray: &Ray, reach: f64, random: &mut SplitMix) -> f64 {
        let fog = ratio_track(&|s| self.fog.extinction(ray.at(s)), self.fog.majorant(), reach, random);
        let Some([from, to]) = flame_interval(ray).filter(|[from, _]| *from < reach) else { return fog };
        let start = Ray { origin: ray.at(from), direction: ray.direction };
        fog * ratio_track(&|s| flame(start.at(s))[0].x, FLAME_MAJORANT, to.min(reach) - from, random)
    }

    /// The lamp's intensity towards a point, through a window of bars.
    fn intensity(&self, to: DVec3) -> DVec3 {
        let [ahead, right, up] = self.lamp_axes;
        let along = to.dot(ahead);
        if along <= 0.0 {
            return DVec3::ZERO;
        }
        let at = DVec2::new(to.dot(right), to.dot(up)) / (along * CONE);
        let radius = at.length();
        if radius > 1.0 {
            return DVec3::ZERO;
        }
        // Six sectors of glass between bars, and a ring.
        let turn = at.y.atan2(at.x) / (PI / 3.0);
        let bar = (turn - turn.round()).abs() * radius * (PI / 3.0);
        let open = step(0.035, 0.055, bar).max(step(0.24, 0.20, radius)) * step(1.0, 0.95, radius);
        let ring = step(0.030, 0.050, (radius - 0.52).abs());
        INTENSITY * open * ring
    }

    /// The part of a ray in the lamp's cone: from and to, empty if it misses it.
    fn in_cone(&self, ray: &Ray, reach: f64) -> [f64; 2] {
        let ahead = self.lamp_axes[0];
        let cos_squared = 1.0 / (1.0 + CONE * CONE);
        let (to, d) = (ray.origin - LAMP, ray.direction);
        let a = d.dot(ahead).powi(2) - cos_squared;
        let b = d.dot(ahead) * to.dot(ahead) - cos_squared * d.dot(to);
        let c = to.dot(ahead).powi(2) - cos_squared * to.length_squared();
        let root = b * b - a * c;
        if root <= 0.0 {
            return [0.0, if a > 0.0 && to.dot(ahead) > 0.0 { reach } else { 0.0 }];
        }
        let (first, second) = ((-b - root.sqrt()) / a, (-b + root.sqrt()) / a);
        let (near, far) = (first.min(second), first.max(second));
        // A ray that is steeper than the cone is in it before or behind both places, in this nappe or in the other.
        let [from, to] = match (a > 0.0, d.dot(ahead) > 0.0) {
            (true, true) => [far, reach],
            (true, false) => [0.0, near],
            (false, _) if (to + d * (0.5 * (near + far))).dot(ahead) > 0.0 => [near, far],
            (false, _) => [0.0, 0.0],
        };
        [from.max(0.0), to.min(reach)]
    }

    /// The lamp's light without its cosine: the direction in which it travels and the irradiance across it.
    fn lamp_at(&self, point: DVec3, lens: f64, random: &mut SplitMix) -> Option<(DVec3, DVec3)> {
        let to = point - LAMP;
        let intensity = self.intensity(to);
        if intensity == DVec3::ZERO {
            return None;
        }
        let distance = to.length();
        let travel = to / distance;
        let ray = Ray { origin: point, direction: -travel };
        if self.is_blocked(&ray, distance) {
            return None;
        }
        // A disc's irradiance on its axis falls with the square of the distance to its edge.
        let falloff = 1.0 / (distance * distance + lens * lens);
        Some((travel, intensity * (falloff * self.transmittance(&ray, distance, random))))
    }

    /// The same of the flame: one point in it.
    fn flame_at(&self, point: DVec3, blur: f64, random: &mut SplitMix) -> Option<(DVec3, DVec3)> {
        let index = (random.next_number() * FLAME_SOURCES.len() as f64) as usize;
        let [source, intensity] = *FLAME_SOURCES.get(index)?;
        let to = point - source;
        let distance = to.length();
        let travel = to / distance.max(1e-6);
        let ray = Ray { origin: point, direction: -travel };
        if self.is_blocked(&ray, distance) {
            return None;
        }
        // Next to the flame a point is a poor stand-in for it.
        let falloff = FLAME_SOURCES.len() as f64 / (distance * distance + blur * blur);
        Some((travel, intensity * (falloff * self.transmittance(&ray, distance, random))))
    }

    /// Light that arrives at a point of the fog and is scattered into `direction`, per event, for paths with several events.
    fn scattered(&self, point: DVec3, direction: DVec3, random: &mut SplitMix) -> DVec3 {
        let lights = [self.lamp_at(point, BLUR, random), self.flame_at(point, BLUR, random)];
        lights
            .into_iter()
            .flatten()
            .map(|(travel, light)| light * (self.fog.albedo * phase(travel.dot(direction), self.fog.g)))
            .sum()
    }

    /// Light of lamp and flame that a surface reflects.
    fn reflected(&self, ray: &Ray, surface: &Surface, random: &mut SplitMix) -> DVec3 {
        let point = ray.at(surface.distance) + surface.normal * 1e-4;
        let lights = [self.lamp_at(point, LENS, random), self.flame_at(point, 0.1, random)];
        let lit: DVec3 =
            lights.into_iter().flatten().map(|(travel, light)| light * (-travel.dot(surface.normal)).max(0.0)).sum();
        surface.albedo / PI * lit
    }

    fn is_blocked(&self, ray: &Ray, reach: f64) -> bool {
        let between = |distance: f64| distance > 1e-4 && distance < reach - 1e-3;
        let by_ball = ray.sphere(BALL, BALL_RADIUS).is_some_and(|at| at.into_iter().any(between));
        by_ball || cylinders(ray).any(|(distance, _, _)| between(distance))
    }

    fn surface(&self, ray: &Ray) -> Surface {
        let mut nearest = Surface { distance: FAR, normal: -ray.direction, albedo: DVec3::ZERO };
        let mut nearer = |distance: f64, normal: DVec3, albedo: &dyn Fn(DVec3) -> DVec3| {
            if distance > 1e-4 && distance < nearest.distance {
                nearest = Surface { distance, normal, albedo: albedo(ray.at(distance)) };
            }
        };
        if let Some(distance) = ray.plane(DVec3::ZERO, DVec3::Y) {
            nearer(distance, DVec3::Y, &flagstones);
        }
        if let Some(distance) = ray.plane(DVec3::Z * WALL, DVec3::Z) {
            nearer(distance, DVec3::Z, &bricks);
        }
        for (distance, normal, index) in cylinders(ray) {
            let stone = DVec3::new(0.46, 0.43, 0.39);
            let albedo = if index == 4 { DVec3::new(0.16, 0.13, 0.11) } else { stone };
            nearer(distance, normal, &|at| {
                albedo * (0.75 + 0.5 * fractal(DVec2::new(at.x + at.z, at.y) * 5.0, 3, 930))
            });
        }
        if let Some([distance, _]) = ray.sphere(BALL, BALL_RADIUS) {
            nearer(distance, (ray.at(distance) - BALL) / BALL_RADIUS, &|_| DVec3::new(0.72, 0.70, 0.66));
        }
        nearest
    }

    /// Light scattered or reflected at least twice, by a path that begins at an event or at the first surface.
    fn indirect(&self, ray: &Ray, surface: Surface, random: &mut SplitMix) -> DVec3 {
        let (mut ray, mut surface) = (*ray, surface);
        let (mut weight, mut light) = (DVec3::ONE, DVec3::ZERO);
        for event in 0..EVENTS {
            let extinction = |s: f64| self.fog.extinction(ray.at(s));
            let scattering = delta_track(&extinction, self.fog.majorant(), surface.distance, random);
            if let Some(distance) = scattering {
                let point = ray.at(distance);
                if event > 0 {
                    light += weight * self.scattered(point, -ray.direction, random);
                }
                weight *= self.fog.albedo;
                let towards = scatter(ray.direction, self.fog.g, random);
                ray = Ray { origin: point, direction: towards };
            } else {
                if event > 0 {
                    light += weight * self.reflected(&ray, &surface, random);
                }
                weight *= surface.albedo;
                let point = ray.at(surface.distance) + surface.normal * 1e-4;
                ray = Ray { origin: point, direction: by_cosine(surface.normal, random) };
            }
            if weight.max_element() < 0.01 {
                break;
            }
            surface = self.surface(&ray);
        }
        light
    }

    /// Light scattered once on the way to a surface: points chosen by the angle under which the lamp sees them.
    ///
    /// Source: C. Kulla and M. Fajardo, *Importance Sampling Techniques for Path Tracing in Participating Media*, EGSR 2012.
    fn scattered_once(&self, ray: &Ray, reach: f64, random: &mut SplitMix) -> DVec3 {
        let mut light = DVec3::ZERO;
        for (source, is_lamp) in [(LAMP, true), (FLAME + DVec3::Y * (0.4 * FLAME_HEIGHT), false)] {
            let nearest = (source - ray.origin).dot(ray.direction);
            let away = (source - ray.at(nearest)).length().max(0.05);
            let [from, to] = if is_lamp { self.in_cone(ray, reach) } else { [0.0, reach] };
            if to <= from {
                continue;
            }
            let [from, to] = [from, to].map(|s| ((s - nearest) / away).atan());
            let points = if is_lamp { POINTS } else { 2 };
            for point in 0..points {
                let share = (f64::from(point) + random.next_number()) / f64::from(points);
                let distance = nearest + away * (from + (to - from) * share).tan();
                let density = away / ((to - from) * (away * away + (distance - nearest).powi(2)));
                let at = ray.at(distance);
                let arriving = if is_lamp { self.lamp_at(at, LENS, random) } else { self.flame_at(at, 0.15, random) };
                if let Some((travel, arrives)) = arriving {
                    let event =
                        self.fog.extinction(at) * self.fog.albedo * phase(-travel.dot(ray.direction), self.fog.g);
                    light +=
                        arrives * (event * self.transmittance(ray, distance, random) / (density * f64::from(points)));
                }
            }
        }
        light
    }

    /// Light that the flame emits along a ray.
    fn emitted(&self, ray: &Ray, reach: f64, random: &mut SplitMix) -> DVec3 {
        let Some([from, to]) = flame_interval(ray) else { return DVec3::ZERO };
        let to = to.min(reach);
        if to <= from {
            return DVec3::ZERO;
        }
        const POINTS: u32 = 4;
        let point = |index: u32, random: &mut SplitMix| {
            let at = from + (to - from) * (f64::from(index) + random.next_number()) / f64::from(POINTS);
            let [extinction, radiance] = flame(ray.at(at));
            if extinction.x <= 0.0 {
                return DVec3::ZERO;
            }
            extinction * radiance * self.transmittance(ray, at, random)
        };
        (0..POINTS).map(|index| point(index, random)).sum::<DVec3>() * ((to - from) / f64::from(POINTS))
    }
}

/// Where a ray meets the sides and tops of the cylinders, with the normals.
fn cylinders(ray: &Ray) -> impl Iterator<Item = (f64, DVec3, usize)> {
    CYLINDERS.iter().enumerate().flat_map(move |(index, &[x, z, radius, top])| {
        let side = ray.cylinder(DVec2::new(x, z), radius).and_then(|found| {
            let outside = found.into_iter().find(|distance| *distance > 1e-4)?;
            let at = ray.at(outside);
            (at.y < top).then(|| (outside, DVec3::new(at.x - x, 0.0, at.z - z) / radius, index))
        });
        let lid = ray.plane(DVec3::Y * top, DVec3::Y).and_then(|distance| {
            let at = ray.at(distance);
            (DVec2::new(at.x - x, at.z - z).length() < radius).then_some((distance, DVec3::Y, index))
        });
        side.into_iter().chain(lid)
    })
}

fn flagstones(at: DVec3) -> DVec3 {
    let place = DVec2::new(at.x, at.z) * 1.25;
    let stone = place.floor();
    let edge = (place - stone - 0.5).abs().max_element();
    let tone = 0.7 + 0.5 * fractal(stone * 3.7 + 0.5, 1, 931) + 0.35 * (fractal(place * 6.0, 4, 932) - 0.5);
    DVec3::new(0.33, 0.30, 0.27) * tone * (1.0 - 0.65 * step(0.47, 0.49, edge))
}

fn bricks(at: DVec3) -> DVec3 {
    let mut place = DVec2::new(at.x * 1.4, at.y * 3.2);
    place.x += 0.5 * (place.y.floor().rem_euclid(2.0));
    let brick = place.floor();
    let edge = ((place - brick - 0.5).abs() + DVec2::new(0.02, -0.01)).max_element();
    let tone = 0.6 + 0.6 * fractal(brick * 2.3 + 0.5, 1, 933) + 0.4 * (fractal(place * 4.0, 3, 934) - 0.5);
    DVec3::new(0.34, 0.26, 0.21) * tone * (1.0 - 0.5 * step(0.46, 0.49, edge))
}

impl ImagePlane for Hall {
    fn light(&self, at: DVec2, sampler: &mut Sampler) -> DVec3 {
        let random = &mut sequence(sampler);
        let ray = self.camera.ray(at);
        let surface = self.surface(&ray);
        let reach = surface.distance;
        let mut light = self.emitted(&ray, reach, random) + self.scattered_once(&ray, reach, random);
        light += self.reflected(&ray, &surface, random) * self.transmittance(&ray, reach, random);
        for _ in 0..PATHS {
            // Few paths find the cone: without a limit they would be bright dots.
            light += self.indirect(&ray, surface, random).min(DVec3::splat(LIMIT)) / f64::from(PATHS);
        }
        light
    }
}
