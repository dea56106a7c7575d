//! The picture: a pond with stones below the reflection of sky and trees, through a round polarising filter.

use super::mueller::{UNPOLARISED, boundary, change_of_basis, degree_of_polarisation, polarised, polariser};
use crate::camera::{Pinhole, Ray};
use crate::noise::{WaveTrain, cell, cell_numbers, fractal, gathered_light, smooth, step, wave_slope};
use crate::station::ImagePlane;
use glam::{DVec2, DVec3, DVec4, IVec2};
use gonio_bsdf::ParameterValues;
use gonio_trace::Sampler;

/// The value of each pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PondValue {
    /// Light behind the filter.
    Light,
    /// The degree of polarisation of the light that arrives at the filter, in false colour.
    Degree,
}

/// The scene with values of the parameters.
pub struct Pond {
    shown: PondValue,
    camera: Pinhole,
    index: f64,
    ripples: f64,
    /// The angle of the axis from the horizontal, if the filter is there.
    filter_rad: Option<f64>,
    to_sun: DVec3,
}

/// The eye's height and the mean depth of the water, m.
const EYE: f64 = 1.7;
const DEPTH: f64 = 0.45;
/// The largest stones of each layer, and their height, m.
const STONES: [f64; 3] = [0.34, 0.19, 0.10];
const HIGHEST_STONE: f64 = 0.5 * STONES[0];
/// Absorption of the water, 1/m.
const ABSORPTION: DVec3 = DVec3::new(0.42, 0.09, 0.12);
/// Radiance of the sun's light on a white surface across it.
const SUNLIT: DVec3 = DVec3::new(1.45, 1.30, 1.05);
const SKYLIT: DVec3 = DVec3::new(0.14, 0.18, 0.23);
/// The filter in the image plane.
const FILTER_CENTER: DVec2 = DVec2::new(0.0, -0.16);
const FILTER_RADIUS: f64 = 0.70;
const RIM: f64 = 0.035;

impl Pond {
    /// The scene.
    pub fn new(values: &ParameterValues, shown: PondValue) -> Self {
        Self {
            shown,
            camera: Pinhole::new(DVec3::new(0.0, EYE, 0.0), DVec3::new(0.0, EYE - 1.37, -3.0), 54.0),
            index: values.number("index"),
            ripples: values.number("ripples"),
            filter_rad: values.is_on("filter").then(|| values.number("angle").to_radians()),
            to_sun: DVec3::new(-0.75, 0.8, 0.25).normalize(),
        }
    }

    /// Sky and far bank from a direction: colour, and the degree and axis of polarisation.
    fn sky(&self, direction: DVec3) -> (DVec3, f64, DVec3) {
        let elevation = direction.y.max(0.0);
        let azimuth = direction.x.atan2(-direction.z);
        let blue = DVec3::new(0.30, 0.58, 1.25).lerp(DVec3::new(1.25, 1.38, 1.55), (1.0 - elevation).powi(5));
        let at = DVec2::new(direction.x, direction.z) / (direction.y.max(0.0) + 0.18);
        let cloud = step(0.47, 0.78, fractal(1.15 * at + DVec2::new(3.7, 1.1), 5, 11));
        let lit = 0.9 + 0.5 * fractal(2.0 * at, 4, 12);
        let mut color = blue.lerp(DVec3::new(2.1, 2.05, 2.0) * lit, 0.92 * cloud);
        let mut clear = 1.0 - 0.92 * cloud;
        // Trees on the far bank.
        let crown = |width: f64, seed: u32| {
            let x = azimuth * width;
            let round = (x - x.floor() - 0.5).abs() * 2.0;
            (1.0 - round.powi(2)).max(0.0) * (0.5 + 0.5 * cell(IVec2::new(x.floor() as i32, 0), seed))
        };
        let leaves = 0.03 * fractal(DVec2::new(azimuth, direction.y) * 60.0, 4, 6);
        let height = 0.055
            + 0.05 * smooth(DVec2::new(azimuth * 2.5, 0.0), 5)
            + 0.07 * crown(7.0, 3).max(crown(11.3, 4))
            + leaves;
        let tree = step(height + 0.004, height - 0.004, direction.y);
        let shade = 0.35 + 1.3 * fractal(DVec2::new(azimuth, direction.y * 1.3) * 38.0, 4, 8);
        let green = DVec3::new(0.055, 0.085, 0.03)
            .lerp(DVec3::new(0.12, 0.14, 0.05), smooth(DVec2::new(azimuth * 9.0, 1.0), 9));
        color = color.lerp(green * shade, tree);
        clear *= 1.0 - tree;
        // Rayleigh scattering; the rest of multiple scattering is not polarised.
        let cos = direction.dot(self.to_sun);
        let degree = 0.75 * clear * (1.0 - cos * cos) / (1.0 + cos * cos);
        (color, degree, direction.cross(self.to_sun).normalize_or(DVec3::X))
    }

    /// The normal of the water.
    fn normal(&self, at: DVec2, distance: f64) -> DVec3 {
        const WAVES: [WaveTrain; 5] =
            [(0.3, 0.9, 0.014), (1.1, 0.53, 0.011), (-0.7, 0.37, 0.010), (2.0, 0.22, 0.007), (0.8, 0.15, 0.006)];
        let visible = |length: f64| step(220.0 * length, 20.0 * length, distance * 8.0);
        let slope = wave_slope(at, &WAVES, 40, visible) * self.ripples * (0.4 + 1.2 * smooth(at * 0.45, 50));
        DVec3::new(-slope.x, 1.0, -slope.y).normalize()
    }

    /// The radiance of the bottom in a direction below the water.
    fn bottom(&self, ray: &Ray) -> DVec3 {
        const STEPS: usize = 9;
        let down = -ray.direction.y.min(-0.05);
        let (start, end) = ((DEPTH - HIGHEST_STONE) / down, (DEPTH + 0.005) / down);
        let along = |index: usize| start + (end - start) * index as f64 / STEPS as f64;
        let below = |t: f64| {
            let at = ray.at(t);
            at.y < highest_stone(DVec2::new(at.x, at.z), at.y + DEPTH).2 - DEPTH
        };
        let mut hit = end;
        for index in 1..=STEPS {
            let t = along(index);
            if below(t) {
                let (mut low, mut high) = (along(index - 1), t);
                for _ in 0..5 {
                    let middle = 0.5 * (low + high);
                    if below(middle) { high = middle } else { low = middle }
                }
                hit = high;
                break;
            }
        }
        let point = ray.at(hit);
        let at = DVec2::new(point.x, point.z);
        let height = |x: f64, y: f64| bottom_height(at + DVec2::new(x, y));
        let normal =
            DVec3::new(height(-0.004, 0.0) - height(0.004, 0.0), 0.008, height(0.0, -0.004) - height(0.0, 0.004));
        // The sun's direction below the water.
        let sun = (DVec3::new(self.to_sun.x, 0.0, self.to_sun.z) / self.index).with_y(0.85).normalize();
        let depth = -point.y;
        let caustics = 0.55
            + 1.9 * self.ripples.min(1.0) * gathered_light(at + DVec2::new(sun.x, sun.z) * depth, 31)
            + 0.45 * (1.0 - self.ripples.min(1.0));
        let crevice = step(-DEPTH - 0.01, -DEPTH + 0.07, point.y);
        let light = SUNLIT * (normal.normalize().dot(sun).max(0.0) * caustics * (0.25 + 0.75 * crevice))
            + SKYLIT * (0.3 + 0.7 * crevice);
        let path = hit + depth / sun.y;
        stone_albedo(at) * light * (-ABSORPTION * path).exp()
    }

    /// The light that arrives along a ray from the camera: two parts, each with its colour and Stokes vector of intensity 1 or
    /// less, in the basis of the camera's horizontal.
    fn arriving(&self, ray: &Ray) -> [(DVec3, DVec4); 2] {
        let k = -ray.direction;
        let horizontal = (DVec3::X - k * k.x).normalize();
        let Some(distance) = ray.plane(DVec3::ZERO, DVec3::Y).filter(|_| ray.direction.y < 0.0) else {
            let (color, degree, axis) = self.sky(ray.direction);
            return [(color, change_of_basis(k, axis, horizontal) * polarised(degree)), (DVec3::ZERO, DVec4::ZERO)];
        };
        let point = ray.at(distance);
        let mut normal = self.normal(DVec2::new(point.x, point.z), distance);
        if normal.dot(k) < 0.02 {
            normal = DVec3::Y;
        }
        let cos = normal.dot(k).max(1e-3);
        let across = k.cross(normal).normalize_or(DVec3::X);
        let [reflection, transmission] = boundary(cos, 1.0, self.index);
        let mut up = ray.direction + 2.0 * cos * normal;
        up.y = up.y.abs();
        let (sky, degree, axis) = self.sky(up);
        let reflected = reflection * change_of_basis(-up, axis, across) * polarised(degree);
        // Light from below: the boundary transmits it as it does light that enters; radiance falls by the index squared.
        let eta = 1.0 / self.index;
        let cos_t = (1.0 - eta * eta * (1.0 - cos * cos)).max(0.0).sqrt();
        let down = eta * ray.direction + (eta * cos - cos_t) * normal;
        let bottom = self.bottom(&Ray { origin: point, direction: down }) / (self.index * self.index);
        let to_camera = change_of_basis(k, across, horizontal);
        [(sky, to_camera * reflected), (bottom, to_camera * (transmission * UNPOLARISED))]
    }
}

/// A stone of a layer at a place: its number, its height above the layer's floor, and 1 at its middle to 0 at its edge.
fn stone(at: DVec2, layer: u32) -> (f64, f64) {
    let size = STONES[layer as usize];
    let place = at / size + f64::from(layer) * 17.3;
    let base = place.floor().as_ivec2();
    let (mut highest, mut number) = (0.0, 0.0);
    for (x, y) in (-1..=1).flat_map(|x| (-1..=1).map(move |y| (x, y))) {
        let here = base.wrapping_add(IVec2::new(x, y));
        let random = cell_numbers(here, 100 + layer);
        // Some cells have no stone of the large layers.
        if layer < 2 && random[5] < [0.45, 0.25][layer as usize] {
            continue;
        }
        let center = here.as_dvec2() + 0.5 + 0.5 * DVec2::new(random[0] - 0.5, random[1] - 0.5);
        if (place - center).length_squared() > 0.44 {
            continue;
        }
        let turned = DVec2::from_angle(std::f64::consts::PI * random[2]).rotate(place - center);
        let radii = DVec2::new(0.42 + 0.24 * random[3], 0.34 + 0.14 * random[4]);
        let square = 1.0 - (turned / radii).length_squared();
        let height = square.max(0.0).powf(0.6) * size * (0.28 + 0.22 * random[6]);
        if height > highest {
            (highest, number) = (height, random[7]);
        }
    }
    (number, highest)
}

/// The layer of the highest stone, its number, and its height; stones that are certainly lower than `least` are left out.
fn highest_stone(at: DVec2, least: f64) -> (u32, f64, f64) {
    let mut found = (3, 0.0, 0.0);
    for layer in (0..3).filter(|layer| 0.5 * STONES[*layer as usize] >= least) {
        let (number, height) = stone(at, layer);
        if height > found.2 {
            found = (layer, number, height);
        }
    }
    found
}

fn bottom_height(at: DVec2) -> f64 {
    highest_stone(at, 0.0).2 - DEPTH
}

fn stone_albedo(at: DVec2) -> DVec3 {
    const COLORS: [DVec3; 6] = [
        DVec3::new(0.42, 0.40, 0.37),
        DVec3::new(0.58, 0.54, 0.46),
        DVec3::new(0.40, 0.27, 0.18),
        DVec3::new(0.24, 0.26, 0.28),
        DVec3::new(0.55, 0.41, 0.26),
        DVec3::new(0.72, 0.70, 0.66),
    ];
    let (layer, number, _) = highest_stone(at, 0.0);
    let grain = 0.65 + 0.7 * fractal(at * 55.0, 3, 21);
    if layer == 3 {
        return DVec3::new(0.50, 0.42, 0.30) * grain;
    }
    let color = COLORS[(number * 6.0) as usize % 6];
    // Veins in some stones.
    let vein = (fractal(at * 14.0, 3, (number * 900.0) as u32) - 0.5).abs();
    let bright = 0.25 * step(0.035, 0.0, vein) * f64::from(u8::from(number > 0.55));
    color * grain + bright
}

impl ImagePlane for Pond {
    fn light(&self, at: DVec2, _: &mut Sampler) -> DVec3 {
        let parts = self.arriving(&self.camera.ray(at));
        if self.shown == PondValue::Degree {
            // The luminance is the weight of each part.
            let weight = |color: DVec3| color.dot(DVec3::new(0.2126, 0.7152, 0.0722));
            return false_color(degree_of_polarisation(parts.iter().map(|(color, s)| *s * weight(*color)).sum()));
        }
        let all = || parts.iter().map(|(color, stokes)| *color * stokes.x).sum();
        let Some(angle) = self.filter_rad else { return all() };
        let place = at - FILTER_CENTER;
        let radius = place.length();
        if radius > FILTER_RADIUS + RIM {
            return all();
        }
        if radius > FILTER_RADIUS {
            return rim(place, (radius - FILTER_RADIUS) / RIM, angle);
        }
        let filter = polariser(angle);
        parts.iter().map(|(color, stokes)| *color * (filter * *stokes).x).sum()
    }
}

/// The rim of the filter, with two marks at its axis. `across`: from 0 inside to 1 outside.
fn rim(place: DVec2, across: f64, angle: f64) -> DVec3 {
    let off_axis = place.normalize().perp_dot(DVec2::from_angle(angle)).abs();
    if off_axis < 0.022 && (0.2..0.8).contains(&across) {
        return DVec3::new(1.3, 1.25, 1.1);
    }
    let metal = 0.025
        + 0.16
            * (-(((across - 0.4) * 5.0).powi(2))).exp()
            * (0.3 + place.normalize().dot(DVec2::new(-0.6, 0.8)).max(0.0));
    DVec3::new(1.0, 1.02, 1.06) * metal
}

/// Dark blue, violet, orange, yellow for 0 to 1, in linear light. Its lightness rises evenly.
fn false_color(share: f64) -> DVec3 {
    const COLORS: [DVec3; 5] = [
        DVec3::new(0.006, 0.004, 0.07),
        DVec3::new(0.13, 0.005, 0.33),
        DVec3::new(0.56, 0.04, 0.20),
        DVec3::new(0.93, 0.30, 0.03),
        DVec3::new(0.95, 0.90, 0.18),
    ];
    let place = share.clamp(0.0, 1.0) * 4.0;
    let index = (place as usize).min(3);
    COLORS[index].lerp(COLORS[index + 1], place - index as f64)
}
