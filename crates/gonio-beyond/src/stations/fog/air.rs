//! The media of the picture: fog with patches, and a flame.

use crate::camera::Ray;
use crate::noise::{cell, step};
use glam::{DVec2, DVec3, IVec2};
use std::sync::LazyLock;

/// Points along each axis of the noise.
const SIDE: usize = 48;

/// Noise in space, periodic with period 1, from 0 to 1.
static NOISE: LazyLock<Vec<f32>> = LazyLock::new(|| {
    let mut noise = Vec::with_capacity(SIDE * SIDE * SIDE);
    for index in 0..SIDE * SIDE * SIDE {
        let at = DVec3::new((index % SIDE) as f64, (index / SIDE % SIDE) as f64, (index / SIDE / SIDE) as f64);
        let octave = |cells: i32, weight: f64| weight * lattice(at / SIDE as f64, cells);
        noise.push((octave(3, 0.5) + octave(6, 0.25) + octave(12, 0.15) + octave(24, 0.10)) as f32);
    }
    noise
});

/// Smooth values of a periodic lattice.
fn lattice(at: DVec3, cells: i32) -> f64 {
    let place = at * f64::from(cells);
    let (floor, f) = (place.floor(), place - place.floor());
    let f = f * f * (3.0 - 2.0 * f);
    let corner = |x: i32, y: i32, z: i32| {
        let at = [floor.x as i32 + x, floor.y as i32 + y, floor.z as i32 + z].map(|i| i.rem_euclid(cells));
        cell(IVec2::new(at[0], at[1]), (at[2] + 64 * cells) as u32)
    };
    let mix = |a: f64, b: f64, t: f64| a + (b - a) * t;
    let row = |y: i32, z: i32| mix(corner(0, y, z), corner(1, y, z), f.x);
    let layer = |z: i32| mix(row(0, z), row(1, z), f.y);
    mix(layer(0), layer(1), f.z)
}

/// The noise at a place, linear between the points.
fn noise(at: DVec3) -> f64 {
    let place = (at - at.floor()) * SIDE as f64;
    let (floor, f) = (place.floor(), (place - place.floor()).as_vec3());
    let [x, y, z] = [floor.x, floor.y, floor.z].map(|i| (i as usize).min(SIDE - 1));
    let next = |i: usize| if i + 1 == SIDE { 0 } else { i + 1 };
    let at = |x: usize, y: usize, z: usize| NOISE[(z * SIDE + y) * SIDE + x];
    let row = |y: usize, z: usize| at(x, y, z) + (at(next(x), y, z) - at(x, y, z)) * f.x;
    let layer = |z: usize| row(y, z) + (row(next(y), z) - row(y, z)) * f.y;
    f64::from(layer(z) + (layer(next(z)) - layer(z)) * f.z)
}

/// Fog.
#[derive(Clone, Copy, Debug)]
pub struct Fog {
    /// Mean extinction where it is even, 1/m.
    pub density: f64,
    /// From even (0) to clouds with clear air between them (1).
    pub patchiness: f64,
    /// The share of an event that is scattering.
    pub albedo: f64,
    /// The mean cosine of scattering.
    pub g: f64,
}

impl Fog {
    /// The largest extinction, 1/m.
    pub fn majorant(&self) -> f64 {
        self.density * (1.0 + 1.4 * self.patchiness)
    }

    /// The extinction at a place, 1/m.
    pub fn extinction(&self, at: DVec3) -> f64 {
        if self.patchiness == 0.0 {
            return self.density;
        }
        let cloud = 2.4 * step(0.36, 0.64, noise(at * DVec3::new(0.23, 0.34, 0.23) + 0.37));
        self.density * (1.0 + (cloud - 1.0) * self.patchiness)
    }
}

/// The flame: its foot, its height and its radius in m.
pub const FLAME: DVec3 = DVec3::new(-1.62, 0.93, 0.55);
pub const FLAME_HEIGHT: f64 = 1.25;
pub const FLAME_RADIUS: f64 = 0.42;
/// Its largest extinction, 1/m: soot, which absorbs and emits.
pub const FLAME_MAJORANT: f64 = 3.0;

/// The extinction of the flame at a place, 1/m, and the radiance that its soot emits.
pub fn flame(at: DVec3) -> [DVec3; 2] {
    let place = at - FLAME;
    let up = place.y / FLAME_HEIGHT;
    if !(0.0..1.0).contains(&up) {
        return [DVec3::ZERO; 2];
    }
    // Tongues: the axis bends, and noise eats the outside, more of it higher up.
    let bend = noise(DVec3::new(0.31, up * 0.55, 0.77)) - 0.5;
    let other = noise(DVec3::new(0.83, up * 0.55, 0.21)) - 0.5;
    let across = DVec2::new(place.x - 0.5 * bend * up, place.z - 0.5 * other * up).length();
    let width = FLAME_RADIUS * (0.80 * (1.0 - up).powf(0.75) * (0.55 + 1.3 * up).min(1.0));
    let eaten = 0.85 * (noise(at * DVec3::new(1.1, 0.62, 1.1)) - 0.42) * (0.4 + up);
    let inside = 1.0 - across / width.max(1e-3) - 1.7 * eaten;
    let soot = step(0.0, 0.38, inside);
    let heat = step(0.0, 0.9, inside) * (1.0 - 0.55 * up);
    let color = DVec3::new(1.0, 0.20, 0.022).lerp(DVec3::new(1.0, 0.58, 0.20), heat);
    [DVec3::splat(FLAME_MAJORANT * soot), color * (4.0 + 16.0 * heat)]
}

/// Points of the flame that send the same energy each.
const SOURCES: usize = 1024;

/// The flame as points: the place, and the intensity in W/sr.
pub static FLAME_SOURCES: LazyLock<Vec<[DVec3; 2]>> = LazyLock::new(|| {
    const STEPS: [usize; 3] = [24, 48, 24];
    let size = DVec3::new(2.0 * FLAME_RADIUS, FLAME_HEIGHT, 2.0 * FLAME_RADIUS);
    let corner = FLAME - DVec3::new(FLAME_RADIUS, 0.0, FLAME_RADIUS);
    let volume = size.x * size.y * size.z / (STEPS[0] * STEPS[1] * STEPS[2]) as f64;
    let mut cells = Vec::new();
    for index in 0..STEPS[0] * STEPS[1] * STEPS[2] {
        let place = [index % STEPS[0], index / STEPS[0] % STEPS[1], index / STEPS[0] / STEPS[1]];
        let share = DVec3::from_array([0, 1, 2].map(|axis| (place[axis] as f64 + 0.5) / STEPS[axis] as f64));
        let at = corner + share * size;
        let [extinction, radiance] = flame(at);
        cells.push([at, extinction * radiance * volume]);
    }
    let total: f64 = cells.iter().map(|cell| cell[1].element_sum()).sum();
    let mut sources = Vec::with_capacity(SOURCES);
    let mut sum = 0.0;
    for [at, intensity] in cells {
        sum += intensity.element_sum();
        while sources.len() < SOURCES && sum > total * (sources.len() as f64 + 0.5) / SOURCES as f64 {
            sources.push([at, intensity * (total / (intensity.element_sum() * SOURCES as f64))]);
        }
    }
    sources
});

/// Where a ray passes the flame's hull.
pub fn flame_interval(ray: &Ray) -> Option<[f64; 2]> {
    let middle = FLAME + DVec3::Y * (0.5 * FLAME_HEIGHT);
    let [enter, leave] = ray.sphere(middle, 0.5 * FLAME_HEIGHT + 0.04)?;
    let [enter, leave] = [enter.max(0.0), leave];
    let [near, far] = ray.cylinder(DVec2::new(FLAME.x, FLAME.z), 1.3 * FLAME_RADIUS)?;
    let [enter, leave] = [enter.max(near), leave.min(far)];
    (leave > enter).then_some([enter, leave])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_majorant_is_never_exceeded() {
        for patchiness in [0.0, 0.4, 1.0] {
            let fog = Fog { density: 0.3, patchiness, albedo: 1.0, g: 0.0 };
            let mut sum = 0.0;
            for index in 0..20_000 {
                let along = f64::from(index);
                let at = DVec3::new((along * 0.377) % 9.0, (along * 0.731) % 7.0, (along * 0.113) % 11.0);
                let extinction = fog.extinction(at);
                assert!((0.0..=fog.majorant()).contains(&extinction), "{patchiness} {at}: {extinction}");
                assert!(flame(at)[0].max_element() <= FLAME_MAJORANT);
                sum += extinction / 20_000.0;
            }
            assert!((sum / 0.3 - 1.0).abs() < 0.25, "{patchiness}: mean {sum}");
        }
    }
}
