//! Eight directions at a time.

use super::target::Target;
use crate::image::Pixel;
use glam::Mat3;
use std::f32::consts::{FRAC_PI_2, PI};
use wide::f32x8;

/// How many go together.
pub(super) const LANES: usize = 8;

/// Eight directions of any length: x, y and z of each.
pub(super) type Directions = [f32x8; 3];

/// Fills a row of the target with what `look_up` finds for eight directions at a time.
#[inline(always)]
pub(super) fn fill_row(
    target: &impl Target,
    row: usize,
    turn: Option<Mat3>,
    pixels: &mut [Pixel],
    look_up: impl Fn(Directions, &mut [Pixel; LANES]),
) {
    let line = target.row(row);
    for (block, pixels) in pixels.chunks_mut(LANES).enumerate() {
        let directions = turned(target.directions(&line, (block * LANES) as f32, FIRST_EIGHT, 0.0), turn);
        fill_block(pixels, |all| look_up(directions, all));
    }
}

/// Fills up to eight pixels, the last ones of a row, from eight.
#[inline(always)]
pub(super) fn fill_block(pixels: &mut [Pixel], look_up: impl FnOnce(&mut [Pixel; LANES])) {
    match <&mut [Pixel; LANES]>::try_from(&mut *pixels) {
        Ok(all) => look_up(all),
        Err(_) => {
            let mut all = [[0.0; 4]; LANES];
            look_up(&mut all);
            pixels.copy_from_slice(&all[..pixels.len()]);
        }
    }
}

/// Columns of a block of eight, from its first.
pub(super) const FIRST_EIGHT: f32x8 = f32x8::new([0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]);

/// The directions, turned.
#[inline]
pub(super) fn turned(d: Directions, turn: Option<Mat3>) -> Directions {
    let Some(m) = turn else { return d };
    let row = |i: usize| d[0] * m.x_axis[i] + d[1] * m.y_axis[i] + d[2] * m.z_axis[i];
    [row(0), row(1), row(2)]
}

/// The angle of the point (`x`, `y`) from the axis x, in radians, from -pi to pi: `atan2(y, x)`, to 2e-7. 0 where both are
/// 0.
#[inline(always)]
pub(super) fn angle(y: f32x8, x: f32x8) -> f32x8 {
    let (across, along) = (y.abs(), x.abs());
    let (smaller, larger) = (across.fast_min(along), across.fast_max(along));
    let ratio = smaller / larger.fast_max(f32x8::splat(f32::MIN_POSITIVE));
    let first_eighth = arc_tangent(ratio);
    let first_quarter = across.simd_gt(along).select(FRAC_PI_2 - first_eighth, first_eighth);
    let half = x.simd_lt(f32x8::ZERO).select(PI - first_quarter, first_quarter);
    y.simd_lt(f32x8::ZERO).select(-half, half)
}

/// The arc tangent of numbers from -1 to 1, in radians, to 1e-7.
#[inline(always)]
pub(super) fn arc_tangent(x: f32x8) -> f32x8 {
    let square = x * x;
    let mut sum = f32x8::splat(ARC_TANGENT[ARC_TANGENT.len() - 1]);
    for factor in ARC_TANGENT.iter().rev().skip(1) {
        sum = sum.mul_add(square, f32x8::splat(*factor));
    }
    x * sum
}

/// `atan(x) / x` in powers of `x^2`, for x in [0, 1]: the polynomial through its values at the nine Chebyshev nodes of
/// `x^2` in [0, 1], off by at most 1e-8.
pub const ARC_TANGENT: [f32; 9] = [
    0.999_999_98,
    -0.333_330_37,
    1.999_187_2e-1,
    -1.419_779_8e-1,
    1.061_837_1e-1,
    -7.456_855e-2,
    4.213_762_4e-2,
    -1.573_124_9e-2,
    2.766_283_5e-3,
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_are_those_of_the_standard_library() {
        let mut worst: f32 = 0.0;
        for i in 0..4096 {
            let exact = f64::from(i - 2048) / 2048.0 * std::f64::consts::PI;
            let (x, y) = (exact.cos() as f32 * 3.0, exact.sin() as f32 * 3.0);
            let got = angle(f32x8::splat(y), f32x8::splat(x)).to_array()[3];
            worst = worst.max((got - y.atan2(x)).abs());
        }
        // A step of f32 near pi is 2.4e-7.
        assert!(worst <= 3e-7, "{worst}");
        for (y, x) in [(0.0, 0.0), (0.0, 1.0), (1.0, 0.0), (-1.0, 0.0), (0.0, -1.0)] {
            let got = angle(f32x8::splat(y), f32x8::splat(x)).to_array()[0];
            assert!((got - y.atan2(x)).abs() <= 3e-7, "{y} {x}: {got}");
        }
    }
}
