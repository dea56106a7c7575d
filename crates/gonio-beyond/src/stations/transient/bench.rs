//! The scene: things on a table before a mirror, a lamp that flashes, and the paths of its light with their lengths.

use crate::camera::{Pinhole, Ray};
use crate::noise::{fractal, step};
use crate::random::by_cosine;
use glam::{DVec2, DVec3};
use gonio_bsdf::sampling::SplitMix;
use std::f64::consts::PI;

/// The speed of light, cm/ps.
pub const LIGHT_SPEED: f64 = 0.029_979_245_8;

/// The lamp, its radius, and the energy of its flash per steradian. Lengths in cm; the table is at y = 0.
pub const LAMP: DVec3 = DVec3::new(-19.0, 15.0, 4.0);
const LAMP_RADIUS: f64 = 0.8;
const FLASH: DVec3 = DVec3::new(980.0, 900.0, 780.0);
/// The mirror: its middle, normal, half its sides, the share that it reflects.
const MIRROR: DVec3 = DVec3::new(21.0, 11.5, -10.0);
const MIRROR_NORMAL: DVec3 = DVec3::new(-0.848, 0.0, 0.53);
const MIRROR_HALF: DVec2 = DVec2::new(11.5, 11.0);
const FRAME: f64 = 0.9;
const MIRRORED: f64 = 0.93;
const BALLS: [(DVec3, f64, DVec3); 2] = [
    (DVec3::new(-4.0, 6.5, -9.0), 6.5, DVec3::new(0.82, 0.80, 0.76)),
    (DVec3::new(-6.5, 3.0, 9.0), 3.0, DVec3::new(0.10, 0.48, 0.50)),
];
const BLOCK: [DVec3; 2] = [DVec3::new(3.5, 0.0, 1.0), DVec3::new(10.5, 7.5, 8.0)];
const COLUMN: DVec2 = DVec2::new(-15.5, -15.0);
const COLUMN_RADIUS: f64 = 2.6;
const COLUMN_TOP: f64 = 19.0;
const WALL: f64 = -26.0;
/// Diffuse reflections of a path at most, mirrors between two of them at most.
const REFLECTIONS: u32 = 4;
const MIRRORS: u32 = 3;
/// Directions followed from the first surface.
const DIRECTIONS: u32 = 20;

/// What a ray meets.
enum Met {
    Lamp,
    Mirror,
    Surface { normal: DVec3, albedo: DVec3 },
}

/// A diffuse point.
struct Point {
    at: DVec3,
    normal: DVec3,
    albedo: DVec3,
}

/// The camera of the pictures.
pub fn camera() -> Pinhole {
    Pinhole::new(EYE, DVec3::new(0.8, 7.6, -5.0), 33.0)
}

/// The place of the camera.
pub const EYE: DVec3 = DVec3::new(-1.0, 25.0, 76.0);

/// The mirror image of a place.
pub fn image(at: DVec3) -> DVec3 {
    let normal = MIRROR_NORMAL.normalize();
    at - normal * (2.0 * (at - MIRROR).dot(normal))
}

/// Coordinates on the mirror's plane, from its middle.
fn on_mirror(at: DVec3) -> DVec2 {
    let right = DVec3::Y.cross(MIRROR_NORMAL.normalize());
    DVec2::new((at - MIRROR).dot(right), at.y - MIRROR.y)
}

/// The first thing on a ray with its distance.
fn first(ray: &Ray) -> Option<(f64, Met)> {
    let mut nearest: Option<(f64, Met)> = None;
    let mut add = |distance: f64, met: &dyn Fn(DVec3) -> Met| {
        if distance > 1e-4 && nearest.as_ref().is_none_or(|(best, _)| distance < *best) {
            nearest = Some((distance, met(ray.at(distance))));
        }
    };
    if let Some(distance) = ray.plane(DVec3::ZERO, DVec3::Y) {
        add(distance, &|at| Met::Surface { normal: DVec3::Y, albedo: table(DVec2::new(at.x, at.z)) });
    }
    if let Some(distance) = ray.plane(DVec3::Z * WALL, DVec3::Z) {
        add(distance, &|at| Met::Surface {
            normal: DVec3::Z,
            albedo: DVec3::new(0.62, 0.60, 0.57) * lines(DVec2::new(at.x, at.y)),
        });
    }
    for (center, radius, albedo) in BALLS {
        if let Some([distance, _]) = ray.sphere(center, radius) {
            add(distance, &|at| Met::Surface { normal: (at - center) / radius, albedo });
        }
    }
    if let Some((distance, normal)) = ray.block(BLOCK[0], BLOCK[1]) {
        add(distance, &|_| Met::Surface { normal, albedo: DVec3::new(0.78, 0.33, 0.08) });
    }
    if let Some([distance, _]) = ray.cylinder(COLUMN, COLUMN_RADIUS) {
        let at = ray.at(distance);
        if (0.0..COLUMN_TOP).contains(&at.y) {
            let normal = DVec3::new(at.x - COLUMN.x, 0.0, at.z - COLUMN.y) / COLUMN_RADIUS;
            add(distance, &|_| Met::Surface { normal, albedo: DVec3::new(0.42, 0.22, 0.52) });
        }
    }
    if let Some(distance) = ray.plane(DVec3::Y * COLUMN_TOP, DVec3::Y) {
        let at = ray.at(distance);
        if (DVec2::new(at.x, at.z) - COLUMN).length() < COLUMN_RADIUS {
            add(distance, &|_| Met::Surface { normal: DVec3::Y, albedo: DVec3::new(0.42, 0.22, 0.52) });
        }
    }
    let normal = MIRROR_NORMAL.normalize();
    if let Some(distance) = ray.plane(MIRROR, normal) {
        let place = on_mirror(ray.at(distance)).abs();
        if place.cmplt(MIRROR_HALF).all() {
            let is_glass = ray.direction.dot(normal) < 0.0 && place.cmplt(MIRROR_HALF - FRAME).all();
            let side = -normal * ray.direction.dot(normal).signum();
            let frame = DVec3::new(0.30, 0.17, 0.08);
            add(distance, &|_| if is_glass { Met::Mirror } else { Met::Surface { normal: side, albedo: frame } });
        }
    }
    if let Some([distance, _]) = ray.sphere(LAMP, LAMP_RADIUS) {
        add(distance, &|_| Met::Lamp);
    }
    nearest
}

/// Thin lines every 10 cm.
fn lines(at: DVec2) -> f64 {
    let nearest = ((at / 10.0 + 0.5).fract_gl() - 0.5).abs().min_element() * 10.0;
    1.0 - 0.55 * step(0.14, 0.06, nearest)
}

fn table(at: DVec2) -> DVec3 {
    let grain = fractal(DVec2::new(at.x * 0.05, at.y * 0.6), 4, 120);
    DVec3::new(0.52, 0.50, 0.47) * (0.85 + 0.3 * grain) * lines(at)
}

/// Whether nothing but the lamp itself lies between a point and a place.
fn is_free(from: DVec3, to: DVec3) -> bool {
    let distance = (to - from).length();
    let ray = Ray { origin: from, direction: (to - from) / distance };
    first(&ray).is_none_or(|(met, _)| met > distance - LAMP_RADIUS - 1e-3)
}

/// The paths from the lamp to a point, straight and by the mirror: the direction towards the light, the length, the share that arrives.
fn from_lamp(point: DVec3) -> impl Iterator<Item = (DVec3, f64, f64)> {
    let straight = is_free(point, LAMP).then(|| {
        let to = LAMP - point;
        (to.normalize(), to.length(), 1.0)
    });
    let virtual_lamp = image(LAMP);
    let ray = Ray { origin: point, direction: (virtual_lamp - point).normalize() };
    let normal = MIRROR_NORMAL.normalize();
    let mirrored = ray.plane(MIRROR, normal).filter(|_| ray.direction.dot(normal) < 0.0).and_then(|distance| {
        let turn = ray.at(distance);
        let is_glass = on_mirror(turn).abs().cmplt(MIRROR_HALF - FRAME).all();
        let before = turn + normal * 1e-3;
        let is_open =
            is_glass && is_free(before, LAMP) && first(&ray).is_some_and(|(met, _)| (met - distance).abs() < 1e-6);
        is_open.then(|| (ray.direction, distance + (LAMP - turn).length(), MIRRORED))
    });
    straight.into_iter().chain(mirrored)
}

/// The light of a path, and its length in cm.
pub type Arrival = (DVec3, f64);

/// All light that arrives along a ray, each path with its length. `arrive` is called for each of them.
pub fn arrivals(ray: &Ray, random: &mut SplitMix, arrive: &mut impl FnMut(Arrival)) {
    let Some((point, weight, length)) = follow(ray, arrive) else { return };
    direct(&point, weight, length, arrive);
    for _ in 0..DIRECTIONS {
        indirect(&point, weight / f64::from(DIRECTIONS), length, random, arrive);
    }
}

/// Follows a ray over mirrors to a diffuse point: the share of its light that comes back, and the length.
fn follow(ray: &Ray, arrive: &mut impl FnMut(Arrival)) -> Option<(Point, f64, f64)> {
    let (mut ray, mut weight, mut length) = (*ray, 1.0, 0.0);
    for _ in 0..=MIRRORS {
        let (distance, met) = first(&ray)?;
        length += distance;
        let at = ray.at(distance);
        match met {
            Met::Lamp => {
                // The radiance of a sphere with this intensity.
                arrive((FLASH * (weight / (PI * LAMP_RADIUS * LAMP_RADIUS)), length));
                return None;
            }
            Met::Mirror => {
                weight *= MIRRORED;
                let normal = MIRROR_NORMAL.normalize();
                ray = Ray {
                    origin: at + normal * 1e-3,
                    direction: ray.direction - normal * (2.0 * ray.direction.dot(normal)),
                };
            }
            Met::Surface { normal, albedo } => {
                return Some((Point { at: at + normal * 1e-3, normal, albedo }, weight, length));
            }
        }
    }
    None
}

fn direct(point: &Point, weight: f64, length: f64, arrive: &mut impl FnMut(Arrival)) {
    for (direction, way, share) in from_lamp(point.at) {
        let cos = direction.dot(point.normal);
        if cos > 0.0 {
            arrive((FLASH * point.albedo * (weight * share * cos / (PI * way * way)), length + way));
        }
    }
}

/// Light that other surfaces send.
fn indirect(first: &Point, weight: f64, length: f64, random: &mut SplitMix, arrive: &mut impl FnMut(Arrival)) {
    let mut point = Point { ..*first };
    let (mut weights, mut length) = (point.albedo * weight, length);
    for _ in 1..REFLECTIONS {
        let ray = Ray { origin: point.at, direction: by_cosine(point.normal, random) };
        // The lamp's own light is that of `direct`.
        let Some((next, share, way)) = follow(&ray, &mut |_| ()) else { return };
        weights *= share;
        length += way;
        direct(&next, 1.0, length, &mut |(light, length)| arrive((light * weights, length)));
        weights *= next.albedo;
        point = next;
    }
}

/// The light of a weak lamp that burns all the time, along a ray.
pub fn steady_lamp(ray: &Ray) -> DVec3 {
    let Some((point, weight, _)) = follow(ray, &mut |_| ()) else { return DVec3::splat(0.004) };
    let shade = 0.35 + 0.65 * (0.5 + 0.5 * point.normal.dot(DVec3::new(0.3, 0.8, 0.52)));
    point.albedo * DVec3::new(0.22, 0.36, 0.78) * (weight * shade)
}
