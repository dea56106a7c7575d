//! Textures of the pictures: noise that depends on the place only.

use glam::{DVec2, IVec2};

/// A number in `[0, 1)` for a cell of a grid.
pub fn cell(at: IVec2, seed: u32) -> f64 {
    let mut h = (at.x as u32).wrapping_mul(0x9E37_79B1)
        ^ (at.y as u32).wrapping_mul(0x85EB_CA77)
        ^ seed.wrapping_mul(0xC2B2_AE3D);
    for _ in 0..2 {
        h ^= h >> 16;
        h = h.wrapping_mul(0x7FEB_352D);
        h ^= h >> 15;
        h = h.wrapping_mul(0x846C_A68B);
    }
    f64::from(h ^ h >> 16) / 4_294_967_296.0
}

/// Eight independent numbers in `[0, 1)` for a cell of a grid, in steps of 1/256: cheaper than [`cell`] eight times.
pub fn cell_numbers(at: IVec2, seed: u32) -> [f64; 8] {
    let place = u64::from(at.x as u32) | u64::from(at.y as u32) << 32;
    // The finaliser of SplitMix64 (G. L. Steele et al., OOPSLA 2014).
    let mut h = place ^ u64::from(seed).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    h = (h ^ h >> 30).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    h = (h ^ h >> 27).wrapping_mul(0x94D0_49BB_1331_11EB);
    (h ^ h >> 31).to_le_bytes().map(|byte| f64::from(byte) / 256.0)
}

/// Values of the cells, smoothly interpolated, in `[0, 1)`.
pub fn smooth(at: DVec2, seed: u32) -> f64 {
    let floor = at.floor();
    let (f, i) = (at - floor, floor.as_ivec2());
    let f = f * f * (3.0 - 2.0 * f);
    let at = |x: i32, y: i32| cell(i.wrapping_add(IVec2::new(x, y)), seed);
    let row = |y: i32| at(0, y) + (at(1, y) - at(0, y)) * f.x;
    row(0) + (row(1) - row(0)) * f.y
}

/// The sum of `octaves` of [`smooth`], each twice as fine and half as strong, in `[0, 1)`.
pub fn fractal(at: DVec2, octaves: u32, seed: u32) -> f64 {
    let (mut sum, mut weight, mut at) = (0.0, 0.5, at);
    for octave in 0..octaves {
        sum += weight * smooth(at, seed.wrapping_add(octave));
        weight *= 0.5;
        // Turned, so that the octaves' grids do not coincide.
        at = DVec2::new(1.6 * at.x - 1.2 * at.y, 1.2 * at.x + 1.6 * at.y);
    }
    sum / (1.0 - 2.0 * weight)
}

/// A train of waves: the angle of its direction, its length in m, its steepness.
pub type WaveTrain = (f64, f64, f64);

/// The slope of water with waves. `visible`: the share of a train of a length that is drawn, 0 where it is smaller than a pixel.
pub fn wave_slope(at: DVec2, trains: &[WaveTrain], seed: u32, visible: impl Fn(f64) -> f64) -> DVec2 {
    let slope = |(index, &(angle, length, steepness)): (usize, &WaveTrain)| {
        let direction = DVec2::from_angle(angle);
        let bend = 1.6 * smooth(at * 0.9, seed + index as u32);
        let phase = (direction.dot(at) / length + bend) * std::f64::consts::TAU;
        direction * (steepness * phase.cos() * visible(length))
    };
    trains.iter().enumerate().map(slope).sum()
}

/// Bright lines as waves gather sunlight on a bottom, 0 to 1.
pub fn gathered_light(at: DVec2, seed: u32) -> f64 {
    let warp = DVec2::new(smooth(at * 2.6, seed), smooth(at * 2.6, seed + 1)) * 0.45;
    let line = |scale: f64, seed: u32| (1.0 - 4.4 * (fractal((at + warp) * scale, 2, seed) - 0.5).abs()).max(0.0);
    (line(3.1, seed + 2) * line(4.3, seed + 3)).powi(2)
}

/// 0 below `from`, 1 above `to`, smooth between.
pub fn step(from: f64, to: f64, x: f64) -> f64 {
    let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_stays_between_0_and_1_near_the_horizon() {
        for far in [0.0, -7.3, 1e9, -1e12, 1e300] {
            for at in [DVec2::new(far, 2.5), DVec2::new(2.5, far), DVec2::splat(far)] {
                let values = [smooth(at, 1), fractal(at, 4, 2)];
                assert!(values.iter().all(|value| (0.0..1.0).contains(value)), "{at}: {values:?}");
            }
        }
    }
}
