//! The pictures: a cuvette with a dye, and a crystal.

use super::beam;
use super::beam::{GaussianBeam, second_harmonic};
use crate::noise::{fractal, smooth, step};
use crate::station::ImagePlane;
use glam::{DVec2, DVec3};
use gonio_trace::Sampler;

/// Fluorescein's light, blue laser light, and light of 532 nm, in linear sRGB.
const DYE: DVec3 = DVec3::new(0.16, 1.0, 0.20);
const BLUE: DVec3 = DVec3::new(0.03, 0.10, 1.0);
const GREEN: DVec3 = DVec3::new(0.05, 1.0, 0.06);
/// Infrared light is invisible; it is drawn so that the eye can follow it.
const INFRARED: DVec3 = DVec3::new(0.30, 0.012, 0.010);

/// The glow for intensity 1 and for its square, so that the default focus is as bright in both beams.
const ONE_PHOTON: f64 = 0.11;
const TWO_PHOTONS: f64 = 4.0e-5;

/// Beams in a cuvette. A unit of the image plane is 1 cm.
pub struct Cuvette {
    beam: GaussianBeam,
}

/// The cuvette: half its width, bottom, top; its wall; the height of the dye. The heights of the beams, the end of the objectives.
const HALF: f64 = 0.78;
const LOW: f64 = -0.66;
const HIGH: f64 = 0.78;
const WALL: f64 = 0.055;
const DYE_TOP: f64 = 0.60;
const ONE: f64 = 0.26;
const TWO: f64 = -0.26;
const OBJECTIVE: f64 = -0.93;
/// The table's edge.
const TABLE: f64 = -0.70;

impl Cuvette {
    /// The beams with a power and a Rayleigh range, cm.
    pub fn new(power: f64, rayleigh_range: f64) -> Self {
        Self { beam: beam(power, rayleigh_range) }
    }

    /// The glow at a place, scattered light of the dye included.
    fn glow(&self, at: DVec2) -> DVec3 {
        let (beam, z) = (&self.beam, at.x);
        let one = ONE_PHOTON * beam.seen(1, at.y - ONE, z);
        let two = TWO_PHOTONS * beam.seen(2, at.y - TWO, z);
        // The dye absorbs and emits its own light again: a veil around each source.
        let power = beam.power;
        let veil_one = 0.085 * power * (-(at.y - ONE).abs() / 0.16).exp();
        let from_focus = DVec2::new(at.x * (0.08 / beam.rayleigh_range).min(1.6), at.y - TWO).length();
        let veil_two = 0.10 * power * power * (0.07 / beam.rayleigh_range).min(2.0) * (-from_focus / 0.13).exp();
        DYE * (one + two + veil_one + veil_two)
    }

    fn scene(&self, at: DVec2) -> DVec3 {
        let back = background(at);
        let wall = at.x.abs() < HALF && at.y > LOW && at.y < HIGH;
        let mut light = back;
        if wall {
            let inside = DVec2::new(HALF - WALL - at.x.abs(), at.y - LOW - WALL);
            if inside.min_element() > 0.0 {
                if at.y < DYE_TOP {
                    light = back * DVec3::new(0.55, 0.75, 0.35) + self.glow(at);
                    // The meniscus and the surface.
                    let bend = 0.035 * (-inside.x / 0.05).exp();
                    light += DYE * 0.10 * step(0.020, 0.0, (DYE_TOP - at.y + bend - 0.03).abs());
                } else {
                    light = back * 0.92 + 0.004;
                }
            } else {
                // The wall guides light to its edges.
                let along = self.glow(DVec2::new(at.x.clamp(-HALF + WALL, HALF - WALL), at.y.max(LOW + WALL))) * 0.35;
                light = back * 0.6 + along * if at.y < DYE_TOP { 1.0 } else { 0.1 } + DVec3::splat(0.012);
            }
            let edge = [HALF - at.x.abs(), (HALF - WALL - at.x.abs()).abs(), at.y - LOW];
            let nearest = edge.into_iter().fold(f64::INFINITY, f64::min);
            light += DVec3::new(0.16, 0.22, 0.24) * step(0.010, 0.002, nearest);
            // A long reflection of the window.
            light += DVec3::new(0.05, 0.055, 0.065) * step(0.02, 0.0, (at.x + 0.58 + 0.02 * at.y).abs() - 0.035);
        } else {
            light += self.before(at);
        }
        objective(at, ONE).or_else(|| objective(at, TWO)).unwrap_or(light)
    }

    /// The beams in the air, by a little dust.
    fn before(&self, at: DVec2) -> DVec3 {
        if at.x < OBJECTIVE {
            return DVec3::ZERO;
        }
        let dust = 0.5 + fractal(at * 30.0, 3, 700);
        let weak = 0.010 * dust;
        BLUE * weak * 3.0 * self.beam.seen(1, at.y - ONE, at.x) + INFRARED * weak * self.beam.seen(1, at.y - TWO, at.x)
    }
}

fn background(at: DVec2) -> DVec3 {
    let glow = (-(at - DVec2::new(0.3, 0.5)).length_squared() * 0.8).exp();
    if at.y < TABLE {
        let hole = (at * DVec2::new(5.0, 9.0)).fract_gl() - 0.5;
        let thread = step(0.13, 0.09, DVec2::new(hole.x, hole.y * 0.8).length());
        return DVec3::new(0.012, 0.013, 0.015) * (1.0 - 0.8 * thread);
    }
    DVec3::new(0.0045, 0.006, 0.010) * (0.4 + glow) * (0.85 + 0.3 * smooth(at * 2.0, 701))
}

/// A microscope objective that ends at the left of the cuvette.
fn objective(at: DVec2, height: f64) -> Option<DVec3> {
    let y = at.y - height;
    let end = OBJECTIVE - at.x;
    if end < 0.0 {
        return None;
    }
    let radius = if end < 0.16 { 0.10 + 0.45 * end } else { 0.19 };
    let across = y / radius;
    if across.abs() > 1.0 {
        return None;
    }
    let round = (1.0 - across * across).sqrt();
    let shine = 0.5 * (-((across - 0.45) / 0.10).powi(2)).exp() + 0.25 * (-((across + 0.6) / 0.16).powi(2)).exp();
    let metal = DVec3::new(0.055, 0.058, 0.064) * (0.25 + 0.75 * round) + DVec3::splat(0.30) * shine;
    let ring = [(0.20, DVec3::new(0.02, 0.11, 0.35)), (0.27, DVec3::splat(0.02))];
    let band = ring.into_iter().find(|(place, _)| (end - place).abs() < 0.016);
    Some(band.map_or(metal, |(_, color)| color * (0.3 + round) + DVec3::splat(0.12) * shine))
}

impl ImagePlane for Cuvette {
    fn light(&self, at: DVec2, _: &mut Sampler) -> DVec3 {
        if at.y > TABLE {
            return self.scene(at);
        }
        // The table mirrors a little.
        let mirrored = DVec2::new(at.x, 2.0 * TABLE - at.y);
        background(at) + self.scene(mirrored) * 0.10 * step(0.5, 0.0, TABLE - at.y)
    }
}

/// A beam through a crystal. A unit of the image plane is 1 cm.
pub struct Crystal {
    power: f64,
    coupling: f64,
}

/// The crystal's ends, half its height; the screen's place; the beam's height.
const CRYSTAL: [f64; 2] = [-0.45, 0.35];
const CRYSTAL_HALF: f64 = 0.24;
const SCREEN: f64 = 0.98;
const BEAM: f64 = -0.02;

impl Crystal {
    /// The crystal for a power of the beam, with the coupling over its whole length.
    pub fn new(power: f64, coupling: f64) -> Self {
        Self { power, coupling }
    }

    /// Powers of both waves at a place along the beam.
    fn powers(&self, x: f64) -> [f64; 2] {
        let through = ((x - CRYSTAL[0]) / (CRYSTAL[1] - CRYSTAL[0])).clamp(0.0, 1.0);
        let second = second_harmonic(self.power, self.coupling * through);
        [self.power - second, second]
    }

    fn scene(&self, at: DVec2) -> DVec3 {
        let mut light = background(at);
        let (y, [first, second]) = (at.y - BEAM, self.powers(at.x));
        let in_crystal = at.x > CRYSTAL[0] && at.x < CRYSTAL[1] && y.abs() < CRYSTAL_HALF;
        if at.x > -1.05 && at.x < SCREEN {
            let dust = if in_crystal { 1.0 } else { 0.45 + 0.5 * fractal(at * DVec2::new(22.0, 40.0), 3, 702) };
            let bell = |width: f64| (-2.0 * (y / width).powi(2)).exp();
            light += (INFRARED * first * bell(0.034) + GREEN * 1.6 * second * bell(0.024)) * dust;
            light += GREEN * 0.06 * second * (-y.abs() / 0.10).exp();
        }
        if in_crystal {
            // Inner reflections of the green light.
            let facets = 0.6 + 0.8 * fractal(at * DVec2::new(3.0, 9.0), 3, 703);
            let lit = 0.05 + 0.55 * self.powers(CRYSTAL[1])[1] * step(CRYSTAL[0] - 0.1, CRYSTAL[1], at.x);
            light += DVec3::new(0.030, 0.045, 0.055) * facets + GREEN * 0.10 * lit * facets;
            let edge = (CRYSTAL_HALF - y.abs()).min(at.x - CRYSTAL[0]).min(CRYSTAL[1] - at.x);
            light += DVec3::new(0.20, 0.26, 0.28) * step(0.012, 0.002, edge);
        }
        let mount = at.x > CRYSTAL[0] - 0.05 && at.x < CRYSTAL[1] + 0.05 && y < -CRYSTAL_HALF && at.y > TABLE;
        if mount {
            let round = 0.5 + 0.5 * (-((at.x + 0.15) / 0.2).powi(2)).exp();
            light = DVec3::new(0.05, 0.05, 0.055) * round * (0.8 + 0.2 * step(-0.30, -0.26, y));
        }
        // The screen, seen from the side at an angle.
        let screen = at.x - SCREEN + 0.06 * y;
        if (0.0..0.30).contains(&screen) && y.abs() < 0.62 {
            let spot = DVec2::new((screen - 0.13) * 2.4, y).length();
            let [_, second] = self.powers(SCREEN);
            let glow = 5.0 * (-(spot / 0.085).powi(2)).exp() + 0.32 * (-spot / 0.16).exp() + 0.02;
            light = DVec3::splat(0.010) + GREEN * second * glow;
        }
        let laser = at.x < -0.98 && y.abs() < 0.17;
        if laser {
            let across = y / 0.17;
            let round = (1.0 - across * across).sqrt();
            let shine = (-((across - 0.4) / 0.14).powi(2)).exp();
            let rim = step(0.03, 0.02, -0.98 - at.x) * 0.5;
            light = DVec3::new(0.05, 0.052, 0.058) * (0.3 + 0.7 * round) + DVec3::splat(0.16) * shine * (1.0 - rim);
        }
        light
    }
}

impl ImagePlane for Crystal {
    fn light(&self, at: DVec2, _: &mut Sampler) -> DVec3 {
        if at.y > TABLE {
            return self.scene(at);
        }
        let mirrored = DVec2::new(at.x, 2.0 * TABLE - at.y);
        background(at) + self.scene(mirrored) * 0.10 * step(0.5, 0.0, TABLE - at.y)
    }
}
