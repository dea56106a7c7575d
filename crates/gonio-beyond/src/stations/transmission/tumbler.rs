//! The picture: a pencil in a glass of water before a card.

use super::{ABSORBED, meet};
use crate::camera::{Pinhole, Ray};
use crate::noise::{fractal, step};
use crate::station::ImagePlane;
use glam::{DVec2, DVec3};
use gonio_bsdf::ParameterValues;
use gonio_trace::Sampler;

/// The glass and what stands around it. Units of 5 cm; the table is at y = 0, the glass stands around the y axis.
pub struct Tumbler {
    camera: Pinhole,
    index: f64,
    absorption: DVec3,
    roughness: f64,
}

/// The glass: radii, height, thickness of the bottom; the water's height.
const OUTER: f64 = 0.80;
const INNER: f64 = 0.735;
const HEIGHT: f64 = 2.30;
const BOTTOM: f64 = 0.16;
const WATER: f64 = 1.40;
/// The index of the glass, and its absorption per unit.
const GLASS: f64 = 1.50;
const GLASS_ABSORPTION: DVec3 = DVec3::new(0.10, 0.035, 0.06);
/// Units in a metre.
const PER_METRE: f64 = 20.0;
/// The pencil: its lower end, its upper end, its radius.
const PENCIL: [DVec3; 2] = [DVec3::new(-0.06, 0.24, -0.34), DVec3::new(0.84, 3.30, -0.16)];
const PENCIL_RADIUS: f64 = 0.085;
/// The card behind the glass, and half its sides.
const CARD_Z: f64 = -2.1;
const CARD: DVec2 = DVec2::new(1.95, 1.30);
const CARD_MIDDLE: f64 = 1.42;
/// A ray with a smaller weight is not followed, and none has more than so many pieces.
const LEAST_WEIGHT: f64 = 0.012;
const MOST_PIECES: u32 = 14;

/// A medium.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Medium {
    Air,
    Glass,
    Liquid,
}

/// What a ray meets next.
enum Next {
    /// A boundary of media at a distance, with its normal.
    Boundary(f64, DVec3),
    /// An opaque surface, with its light.
    Opaque(f64, DVec3),
}

impl Tumbler {
    /// The picture with values of the parameters.
    pub fn new(values: &ParameterValues) -> Self {
        Self {
            camera: Pinhole::new(DVec3::new(0.0, 2.05, 6.4), DVec3::new(0.0, 1.36, 0.0), 31.0),
            index: values.number("index"),
            absorption: ABSORBED * (values.number("absorption") / PER_METRE),
            roughness: values.number("roughness"),
        }
    }

    fn index_of(&self, medium: Medium) -> f64 {
        match medium {
            Medium::Air => 1.0,
            Medium::Glass => GLASS,
            Medium::Liquid => self.index,
        }
    }

    /// The radiance along a ray in a medium. `pieces`: of the path so far.
    fn radiance(&self, ray: &Ray, weight: f64, pieces: u32, sampler: &mut Sampler) -> DVec3 {
        let (distance, opaque, normal) = match next(ray) {
            Next::Opaque(distance, light) => (distance, Some(light), DVec3::ZERO),
            Next::Boundary(distance, normal) => (distance, None, normal),
        };
        const NEAR: f64 = 1e-6;
        let before = medium(ray.at(0.5 * distance));
        let passed = match before {
            Medium::Air => DVec3::ONE,
            Medium::Glass => (-GLASS_ABSORPTION * distance).exp(),
            Medium::Liquid => (-self.absorption * distance).exp(),
        };
        if let Some(light) = opaque {
            return passed * light;
        }
        if pieces >= MOST_PIECES {
            return passed * 0.3;
        }
        let point = ray.at(distance);
        let behind = medium(point + ray.direction * 1e-4);
        let go_on = |direction: DVec3| Ray { origin: point + direction * NEAR, direction };
        let (n_1, n_2) = (self.index_of(before), self.index_of(behind));
        if before == behind || (n_1 - n_2).abs() < 1e-9 {
            return passed * self.radiance(&go_on(ray.direction), weight, pieces + 1, sampler);
        }
        let is_glass = before == Medium::Glass || behind == Medium::Glass;
        let normal = if is_glass && self.roughness > 0.0 { self.facet(normal, ray.direction, sampler) } else { normal };
        let at = meet(ray.direction, normal, n_1, n_2);
        let mut light = DVec3::ZERO;
        let parts = [(at.reflectance, Some(at.reflected)), (1.0 - at.reflectance, at.transmitted)];
        for (share, direction) in parts {
            if let Some(direction) = direction.filter(|_| share * weight > LEAST_WEIGHT) {
                light += share * self.radiance(&go_on(direction), share * weight, pieces + 1, sampler);
            }
        }
        // Radiance per index squared is kept at a boundary, and the ray ends in air as it began: those factors cancel.
        passed * light
    }

    /// The normal of a facet of rough glass, by the distribution of GGX. Source: B. Walter et al., EGSR 2007, (35) and (36).
    fn facet(&self, normal: DVec3, direction: DVec3, sampler: &mut Sampler) -> DVec3 {
        let u = sampler.next_2d().as_dvec2();
        let tan = self.roughness * (u.x / (1.0 - u.x)).sqrt();
        let turn = std::f64::consts::TAU * u.y;
        let (a, b) = normal.any_orthonormal_pair();
        let facet = (normal + tan * (a * turn.cos() + b * turn.sin())).normalize();
        // Facets that turn away from the ray are not met.
        if facet.dot(direction) * normal.dot(direction) > 0.0 { facet } else { normal }
    }
}

/// The medium at a place.
fn medium(at: DVec3) -> Medium {
    let radius = DVec2::new(at.x, at.z).length();
    if radius > OUTER || !(0.0..HEIGHT).contains(&at.y) {
        Medium::Air
    } else if radius > INNER || at.y < BOTTOM {
        Medium::Glass
    } else if at.y < WATER {
        Medium::Liquid
    } else {
        Medium::Air
    }
}

fn next(ray: &Ray) -> Next {
    let mut found = surroundings(ray);
    let mut nearer = |candidate: f64, normal: DVec3| {
        let (Next::Boundary(distance, _) | Next::Opaque(distance, _)) = found;
        if candidate > 1e-7 && candidate < distance {
            found = Next::Boundary(candidate, normal);
        }
    };
    for (radius, low) in [(OUTER, 0.0), (INNER, BOTTOM)] {
        for distance in ray.cylinder(DVec2::ZERO, radius).into_iter().flatten() {
            let point = ray.at(distance);
            if (low..HEIGHT).contains(&point.y) {
                nearer(distance, DVec3::new(point.x, 0.0, point.z).normalize());
            }
        }
    }
    for (height, from, to) in [(BOTTOM, 0.0, INNER), (WATER, 0.0, INNER), (HEIGHT, INNER, OUTER), (0.002, 0.0, OUTER)] {
        if let Some(distance) = ray.plane(DVec3::Y * height, DVec3::Y) {
            let point = ray.at(distance);
            if (from..to).contains(&DVec2::new(point.x, point.z).length()) {
                nearer(distance, DVec3::Y);
            }
        }
    }
    let (Next::Boundary(distance, _) | Next::Opaque(distance, _)) = found;
    match pencil(ray) {
        Some((pencil, light)) if pencil < distance => Next::Opaque(pencil, light),
        _ => found,
    }
}

/// The lamp is a large window to the upper left, behind the camera.
const TO_LAMP: DVec3 = DVec3::new(-0.48, 0.62, 0.62);

/// The distance to the pencil, and its light.
fn pencil(ray: &Ray) -> Option<(f64, DVec3)> {
    let [low, high] = PENCIL;
    let axis = (high - low).normalize();
    let length = (high - low).length();
    let offset = ray.origin - low;
    let across = |v: DVec3| v - axis * v.dot(axis);
    let (o, d) = (across(offset), across(ray.direction));
    let (a, b) = (d.length_squared(), o.dot(d));
    let radius_at = |along: f64| PENCIL_RADIUS * step(-0.02, 0.42, along).max(0.12);
    // The point is a cone, met as a cylinder whose radius is that of the place found before.
    let mut radius = PENCIL_RADIUS;
    let mut found = None;
    for _ in 0..4 {
        let root = b * b - a * (o.length_squared() - radius * radius);
        if root <= 0.0 {
            return None;
        }
        let distance = (-b - root.sqrt()) / a;
        let along = (offset + ray.direction * distance).dot(axis);
        found = Some((distance, along));
        radius = radius_at(along);
    }
    let (distance, along) = found.filter(|(distance, along)| *distance > 1e-7 && (0.0..length).contains(along))?;
    let normal = across(ray.at(distance) - low).normalize();
    // A hexagon's sides.
    let (u, v) = axis.any_orthonormal_pair();
    let turn = normal.dot(v).atan2(normal.dot(u));
    let side = (turn / std::f64::consts::FRAC_PI_3).round() * std::f64::consts::FRAC_PI_3;
    let flat = normal.lerp(u * side.cos() + v * side.sin(), 0.75).normalize();
    let from_end = length - along;
    let albedo = if along < 0.13 {
        DVec3::splat(0.03)
    } else if along < 0.44 {
        DVec3::new(0.72, 0.48, 0.26)
    } else if from_end < 0.24 {
        DVec3::new(0.80, 0.28, 0.30)
    } else if from_end < 0.38 {
        DVec3::splat(0.42 + 0.25 * (from_end * 150.0).sin())
    } else {
        DVec3::new(0.92, 0.44, 0.02)
    };
    let lit = flat.dot(TO_LAMP.normalize()).max(0.0);
    let shine = (flat - ray.direction).normalize().dot(TO_LAMP.normalize()).max(0.0).powi(30);
    Some((distance, albedo * (0.32 + 0.95 * lit) + 0.10 * shine))
}

/// Table, card, wall and window.
fn surroundings(ray: &Ray) -> Next {
    if let Some(distance) = ray.plane(DVec3::Z * CARD_Z, DVec3::Z) {
        let point = ray.at(distance);
        let place = DVec2::new(point.x, point.y - CARD_MIDDLE);
        if place.x.abs() < CARD.x && place.y.abs() < CARD.y && point.y > 0.0 {
            return Next::Opaque(distance, card(place));
        }
    }
    if let Some(distance) = ray.plane(DVec3::ZERO, DVec3::Y).filter(|distance| ray.at(*distance).z > -9.0) {
        let point = ray.at(distance);
        return Next::Opaque(distance, table(DVec2::new(point.x, point.z)));
    }
    let d = ray.direction;
    if d.z < 0.0 {
        // The wall behind, out of focus.
        let glow = (-(DVec2::new(d.x + 0.25, d.y - 0.2)).length_squared() * 3.0).exp();
        return Next::Opaque(1e3, DVec3::new(0.16, 0.20, 0.24) + DVec3::new(0.34, 0.31, 0.27) * glow);
    }
    // The room behind the camera: dark, with a window of four panes.
    let window = DVec2::new(d.x / d.z.max(1e-3) + 0.78, d.y / d.z.max(1e-3) - 0.62).abs();
    let is_pane = window.x < 0.36 && window.y < 0.46 && window.x > 0.02 && window.y > 0.02;
    Next::Opaque(1e3, if is_pane { DVec3::new(4.2, 4.5, 4.9) } else { DVec3::new(0.10, 0.10, 0.11) * (1.0 + d.y) })
}

/// A card with two arrows that point to the right.
fn card(place: DVec2) -> DVec3 {
    let arrow = |middle: f64| {
        let at = DVec2::new(place.x + 0.06, place.y - middle);
        let shaft = at.x > -0.52 && at.x < 0.22 && at.y.abs() < 0.075;
        let head = at.x >= 0.22 && at.x < 0.60 && at.y.abs() < 0.24 * (0.60 - at.x) / 0.38;
        shaft || head
    };
    let shade = 0.86 + 0.10 * (0.4 * place.y - 0.3 * place.x);
    if arrow(0.52) {
        return DVec3::new(0.05, 0.16, 0.52) * shade;
    }
    if arrow(-0.56) {
        return DVec3::new(0.66, 0.045, 0.035) * shade;
    }
    let stripe = step(0.012, 0.006, (place.abs() - (CARD - 0.09)).abs().min_element());
    let inside = place.abs().cmplt(CARD - 0.075).all();
    let line = if inside { 0.5 * stripe } else { 0.0 };
    DVec3::new(0.88, 0.85, 0.78) * shade * (1.0 - line)
}

fn table(at: DVec2) -> DVec3 {
    let grain = fractal(DVec2::new(at.x * 9.0, at.y * 0.9) + 1.2 * fractal(at * 0.8, 3, 640), 5, 641);
    let wood = DVec3::new(0.20, 0.105, 0.05).lerp(DVec3::new(0.46, 0.28, 0.15), grain);
    // Shadows of the glass and the card, away from the window; the bright heart of the first is light that the water gathers.
    let from_glass = at - DVec2::new(0.42, -0.52);
    let shadow = 0.45 * step(1.15, 0.55, DVec2::new(from_glass.x * 0.9 + 0.5 * from_glass.y, from_glass.y).length());
    let contact = 0.5 * (-((at.length() - OUTER).max(0.0) / 0.12)).exp();
    let behind = 0.4 * step(-1.4, -2.2, at.y) * step(2.4, 1.7, at.x.abs());
    wood * (0.82 - 0.25 * step(2.0, -6.0, at.y)) * (1.0 - shadow) * (1.0 - contact) * (1.0 - behind)
}

impl ImagePlane for Tumbler {
    fn light(&self, at: DVec2, sampler: &mut Sampler) -> DVec3 {
        self.radiance(&self.camera.ray(at), 1.0, 0, sampler)
    }
}
