//! The pictures: a drawing with highlighters, and a reradiation matrix.

use super::inks::{self, Ink};
use super::reradiation::{ALL_BANDS, ReradiationMatrix, ULTRAVIOLET_BANDS, WideSpectrum, lambda_of, visible};
use crate::bands::{BANDS, color_of_light, in_gamut};
use crate::camera::Pinhole;
use crate::noise::{fractal, smooth, step};
use crate::station::ImagePlane;
use glam::{DVec2, DVec3};
use gonio_bsdf::ParameterValues;
use gonio_light::observer::daylight;
use gonio_trace::Sampler;

/// A material's colours in the light of the lamp, and in daylight.
#[derive(Clone, Copy, Debug, Default)]
struct LitColors {
    lamp: DVec3,
    room: DVec3,
}

/// The sheet on a desk.
pub struct HighlighterDrawing {
    camera: Pinhole,
    /// In the order of [`inks::ALL`].
    colors: [LitColors; 6],
    wood: LitColors,
    room: f64,
}

/// Half the sides of the sheet.
const SHEET: DVec2 = DVec2::new(1.42, 1.0);
/// Radiance of the lamp's light in the middle of the sheet, per unit of its power.
const LAMP: f64 = 42.0;

impl HighlighterDrawing {
    /// The drawing with values of the parameters.
    pub fn new(values: &ParameterValues) -> Self {
        let lamp = super::lamp(values).map(|light| LAMP * light);
        let day: WideSpectrum = std::array::from_fn(|band| {
            // Little ultraviolet comes through a window.
            if band < ULTRAVIOLET_BANDS { 0.35 * daylight(380.0) } else { daylight(lambda_of(band)) }
        });
        let seen = |out: WideSpectrum| in_gamut(color_of_light(&visible(&out)));
        let lit = |ink: &Ink| {
            let matrix = ink.matrix(values.number("dye"));
            LitColors { lamp: seen(matrix.apply(&lamp)), room: seen(matrix.apply(&day)) }
        };
        let wood = |lambda: f64| 0.06 + 0.22 * step(430.0, 700.0, lambda);
        let wooden = |light: &WideSpectrum| seen(std::array::from_fn(|band| light[band] * wood(lambda_of(band))));
        Self {
            camera: Pinhole::new(DVec3::new(0.0, 2.75, 1.72), DVec3::new(0.0, 0.0, 0.05), 40.0),
            colors: inks::ALL.map(|ink| lit(&ink)),
            wood: LitColors { lamp: wooden(&lamp), room: wooden(&day) },
            room: values.number("room"),
        }
    }
}

/// The distance to a line from `a` to `b`, and the place along it from 0 to 1.
fn segment(at: DVec2, a: DVec2, b: DVec2) -> (f64, f64) {
    let along = ((at - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
    ((at - a - along * (b - a)).length(), along)
}

/// The cover of a stroke, 0 to 1, at a distance from its middle; `along` moves the streaks.
fn stroke(distance: f64, width: f64, along: f64) -> f64 {
    let ragged = width * (1.0 + 0.10 * (fractal(DVec2::new(along * 9.0, 3.0), 3, 201) - 0.5));
    let edge = step(ragged, ragged - 0.012, distance);
    let streaks = 0.80 + 0.25 * smooth(DVec2::new(distance / width * 5.0, along * 3.0), 202);
    edge * streaks.min(1.0)
}

/// The cover of each ink at a place on the sheet: y upwards, in the order of [`inks::ALL`] without the paper.
fn covers(at: DVec2) -> [f64; 5] {
    let [mut yellow, mut green, mut orange, mut pink, mut blue] = [0.0_f64; 5];
    let wobble = DVec2::new(smooth(at * 2.3, 203), smooth(at * 2.3, 204)) - 0.5;
    let at = at + 0.035 * wobble;
    let lay = |ink: &mut f64, cover: f64| *ink = ink.max(cover);
    // The rainbow.
    let center = DVec2::new(0.12, -0.52);
    let (radius, angle) = ((at - center).length(), (at.y - center.y).atan2(at.x - center.x));
    if angle > 0.02 {
        for (index, ink) in [&mut pink, &mut orange, &mut yellow, &mut green, &mut blue].into_iter().enumerate() {
            lay(ink, stroke((radius - (1.12 - 0.125 * index as f64)).abs(), 0.058, angle));
        }
    }
    // The sun with its rays, to the upper left.
    let sun = DVec2::new(-1.06, 0.58);
    let from_sun = at - sun;
    let turn = from_sun.y.atan2(from_sun.x);
    lay(&mut yellow, step(0.205, 0.19, from_sun.length()) * (0.82 + 0.18 * smooth(from_sun * 26.0, 205)));
    let ray = std::f64::consts::TAU / 11.0;
    let nearest = (turn / ray).round() * ray;
    let out = DVec2::from_angle(nearest);
    let (distance, along) = segment(at, sun + out * 0.26, sun + out * 0.40);
    lay(&mut orange, stroke(distance, 0.026, along + nearest));
    // Hills of grass.
    let hill = -0.66 + 0.10 * (at.x * 2.1 + 0.6).sin() + 0.05 * (at.x * 4.7).sin();
    let blade = (at.x * 17.0 + 1.4 * (at.y * 3.0).sin()).sin() * 0.045;
    if at.y > -0.94 {
        lay(
            &mut green,
            step(hill + blade, hill + blade - 0.02, at.y)
                * (0.66 + 0.34 * smooth(DVec2::new(at.x * 34.0, at.y * 5.0), 206)),
        );
    }
    // A house.
    let house = at - DVec2::new(0.16, -0.48);
    let wall = house.abs().x.max((house.y - 0.02).abs() + 0.03);
    if wall < 0.21 {
        green = 0.0;
    }
    lay(&mut pink, stroke((wall - 0.19).abs(), 0.026, house.x + house.y));
    let roof = |side: f64| segment(house, DVec2::new(side * 0.27, 0.19), DVec2::new(0.0, 0.45));
    for side in [-1.0, 1.0] {
        let (distance, along) = roof(side);
        lay(&mut orange, stroke(distance, 0.034, along));
    }
    let door = DVec2::new((house.x - 0.06).abs() / 0.055, (house.y + 0.09).abs() / 0.10);
    lay(&mut blue, step(1.0, 0.86, door.x.max(door.y)));
    let window = DVec2::new((house.x + 0.08).abs(), (house.y - 0.06).abs()) / 0.052;
    lay(&mut yellow, step(1.0, 0.8, window.x.max(window.y)));
    // Flowers.
    for (x, y, ink) in [(-1.05, -0.42, 0), (-0.72, -0.50, 1), (-0.42, -0.46, 0), (0.98, -0.42, 1), (1.22, -0.50, 0)] {
        let head = DVec2::new(x, y);
        let (distance, along) = segment(at, head, head - DVec2::new(0.02, 0.26));
        lay(&mut green, stroke(distance, 0.016, along));
        let offset = at - head;
        let petals = 0.085 + 0.028 * (5.0 * offset.y.atan2(offset.x) + x * 9.0).cos();
        let petal = step(petals, petals - 0.012, offset.length()) * step(0.036, 0.046, offset.length());
        if offset.length() < petals {
            // Nothing is drawn below the flowers.
            [yellow, green, orange, pink, blue] = [0.0; 5];
        }
        lay(if ink == 0 { &mut pink } else { &mut orange }, petal);
        lay(&mut yellow, step(0.036, 0.028, offset.length()));
    }
    [yellow, green, orange, pink, blue]
}

impl HighlighterDrawing {
    /// Radiance by a mix of lit colours.
    fn lit(&self, colors: LitColors, lamp: f64) -> DVec3 {
        colors.lamp * lamp + colors.room * self.room
    }

    fn sheet(&self, place: DVec2, lamp: f64) -> DVec3 {
        let paper = self.lit(self.colors[0], lamp) * (0.95 + 0.08 * fractal(place * 40.0, 3, 207));
        let mut light = paper;
        for (cover, colors) in covers(place).into_iter().zip(&self.colors[1..]) {
            // A little of the paper's light comes through.
            light = light.lerp(self.lit(*colors, lamp), 0.88 * cover);
        }
        light
    }
}

impl ImagePlane for HighlighterDrawing {
    fn light(&self, at: DVec2, _: &mut Sampler) -> DVec3 {
        let ray = self.camera.ray(at);
        let Some(distance) = ray.plane(DVec3::ZERO, DVec3::Y) else { return DVec3::ZERO };
        let point = ray.at(distance);
        let desk = DVec2::new(point.x, point.z);
        // The lamp hangs above the sheet, a little to the left.
        let off = (desk - DVec2::new(-0.12, -0.05)).length_squared();
        let lamp = (1.0 + off / 1.9).powf(-2.5) * step(3.2, 0.4, off.sqrt());
        let turned = DVec2::from_angle(0.055).rotate(desk) * DVec2::new(1.0, -1.0);
        let outside = (turned.abs() - SHEET).max(DVec2::ZERO).length();
        if outside == 0.0 && turned.abs().cmple(SHEET).all() {
            return self.sheet(turned, lamp);
        }
        let grain = fractal(DVec2::new(desk.x * 3.0, desk.y * 34.0) + fractal(desk * 2.0, 3, 208), 4, 209);
        let shadow = 0.45 + 0.55 * step(0.0, 0.07, outside);
        // The sheet's own light falls on the desk beside it.
        let glow = self.lit(self.colors[0], lamp) * 0.045 * (-(outside / 0.10)).exp();
        (self.lit(self.wood, lamp) * shadow + glow * DVec3::new(0.9, 0.8, 0.6)) * (0.35 + 0.9 * grain)
    }
}

/// The matrix of an ink as a picture.
pub struct MatrixPicture {
    matrix: ReradiationMatrix,
    /// The colour of each band's light.
    hues: [DVec3; ALL_BANDS],
}

impl MatrixPicture {
    /// The matrix with a share of the dye.
    pub fn new(ink: &Ink, strength: f64) -> Self {
        let hues = std::array::from_fn(|band| {
            let Some(seen) = band.checked_sub(ULTRAVIOLET_BANDS) else { return DVec3::new(0.16, 0.10, 0.24) };
            let mut line = [0.0; BANDS];
            line[seen] = 1.0;
            let color = in_gamut(color_of_light(&line));
            // As bright as each other, and never black at the ends of the spectrum.
            DVec3::splat(0.06) + 0.94 * color / color.max_element().max(1e-9)
        });
        Self { matrix: ink.matrix(strength), hues }
    }
}

impl ImagePlane for MatrixPicture {
    fn light(&self, at: DVec2, _: &mut Sampler) -> DVec3 {
        const HALF: f64 = 0.9;
        let place = (at / HALF + 1.0) * 0.5;
        if !(0.0..1.0).contains(&place.x) || !(0.0..1.0).contains(&place.y) {
            // The light of each band as a scale beside its row and below its column.
            let band = |x: f64| ((x * ALL_BANDS as f64).max(0.0) as usize).min(ALL_BANDS - 1);
            let is_row = (-0.06..-0.02).contains(&place.x) && (0.0..1.0).contains(&place.y);
            let is_column = (-0.06..-0.02).contains(&place.y) && (0.0..1.0).contains(&place.x);
            return match (is_row, is_column) {
                (true, _) => self.hues[band(place.y)],
                (_, true) => self.hues[band(place.x)],
                _ => DVec3::splat(0.008),
            };
        }
        let cell = place * ALL_BANDS as f64;
        let (from, to) = (cell.x as usize, cell.y as usize);
        let entry = self.matrix.at(to.min(ALL_BANDS - 1), from.min(ALL_BANDS - 1));
        // A line every 100 nm.
        let grid = if cell.x % 10.0 < 0.12 || cell.y % 10.0 < 0.12 { 0.012 } else { 0.004 };
        // Emission is spread over many bands: the root shows it beside the diagonal.
        self.hues[to.min(ALL_BANDS - 1)] * entry.max(0.0).sqrt() + grid
    }
}
