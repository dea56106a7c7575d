//! Functions of eight numbers at a time.
//!
//! Sums and products are written out and never fused ([`crate::simd`] explains why), so no `mul_add` here.

use fearless_simd::prelude::*;
use fearless_simd::{f32x8, i32x8};
use glam::Mat3;
use std::f32::consts::{FRAC_2_PI, FRAC_PI_2, PI};

/// The number of lanes.
pub(super) const LANES: usize = 8;

/// Eight directions of any length: x, y and z of each.
pub(super) type Directions<S> = [f32x8<S>; 3];

/// Columns of a block of eight, counted from its first.
#[inline(always)]
pub(super) fn first_eight<S: Simd>(simd: S) -> f32x8<S> {
    f32x8::from_slice(simd, &[0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0])
}

/// The directions, turned.
#[inline(always)]
pub(super) fn turned<S: Simd>(d: Directions<S>, turn: Option<Mat3>) -> Directions<S> {
    let Some(m) = turn else { return d };
    let [x, y, z] = [m.x_axis.to_array(), m.y_axis.to_array(), m.z_axis.to_array()];
    [
        d[0] * x[0] + d[1] * y[0] + d[2] * z[0],
        d[0] * x[1] + d[1] * y[1] + d[2] * z[1],
        d[0] * x[2] + d[1] * y[2] + d[2] * z[2],
    ]
}

/// The angle of the point (`x`, `y`) from the axis x, in radians, from -pi to pi: `atan2(y, x)`, to 3e-7. 0 where both are
/// 0.
#[inline(always)]
pub(super) fn angle<S: Simd>(y: f32x8<S>, x: f32x8<S>) -> f32x8<S> {
    let (across, along) = (y.abs(), x.abs());
    let (smaller, larger) = (across.min(along), across.max(along));
    let ratio = smaller / larger.max(f32::MIN_POSITIVE);
    let first_eighth = arc_tangent(ratio);
    let first_quarter = across.simd_gt(along).select(FRAC_PI_2 - first_eighth, first_eighth);
    let half = x.simd_lt(0.0).select(PI - first_quarter, first_quarter);
    y.simd_lt(0.0).select(-half, half)
}

/// The arc tangent of numbers from -1 to 1, in radians, to 1e-7.
#[inline(always)]
pub(super) fn arc_tangent<S: Simd>(x: f32x8<S>) -> f32x8<S> {
    x * polynomial(x * x, &ARC_TANGENT)
}

/// The sines and the cosines of angles in radians, to 2e-7, from -4 to 4: a turn and a little more.
#[inline(always)]
pub(super) fn sin_cos<S: Simd>(angle: f32x8<S>) -> (f32x8<S>, f32x8<S>) {
    // The nearest multiple of a quarter turn. Adding 8 makes all of them positive, so that cutting off rounds down.
    let quarter: i32x8<S> = (angle * FRAC_2_PI + 8.5).to_int();
    let quarters: f32x8<S> = (quarter - 8).to_float();
    // W. J. Cody and W. Waite, "Software manual for the elementary functions", 1980: the first part has so few digits
    // that its multiples are exact.
    let rest = angle - quarters * QUARTER_TURN[0] - quarters * QUARTER_TURN[1];
    let square = rest * rest;
    let (sine, cosine) = (rest * polynomial(square, &SINE), polynomial(square, &COSINE));
    let is_odd = (quarter & 1).simd_eq(1);
    let (s, c) = (is_odd.select(cosine, sine), is_odd.select(sine, cosine));
    let sine_is_negative = (quarter & 2).simd_eq(2);
    let cosine_is_negative = ((quarter + 1) & 2).simd_eq(2);
    (sine_is_negative.select(-s, s), cosine_is_negative.select(-c, c))
}

/// The polynomial with these factors, that of the zeroth power first.
#[inline(always)]
fn polynomial<S: Simd, const N: usize>(x: f32x8<S>, factors: &[f32; N]) -> f32x8<S> {
    let mut sum = f32x8::splat(x.simd, factors[N - 1]);
    for factor in factors.iter().rev().skip(1) {
        sum = sum * x + *factor;
    }
    sum
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

/// A quarter of a turn in radians, in two parts: 201 / 128, and the rest.
const QUARTER_TURN: [f32; 2] = [1.570_312_5, 4.838_268e-4];

/// `sin(x) / x` in powers of `x^2`: Taylor's series, which leaves out 3e-7 / 2048 at an eighth of a turn.
const SINE: [f32; 5] = [1.0, -1.0 / 6.0, 1.0 / 120.0, -1.0 / 5040.0, 1.0 / 362_880.0];

/// `cos(x)` in powers of `x^2`: Taylor's series, which leaves out 2e-10 at an eighth of a turn.
const COSINE: [f32; 6] = [1.0, -0.5, 1.0 / 24.0, -1.0 / 720.0, 1.0 / 40_320.0, -1.0 / 3_628_800.0];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd::{Kernel, SimdLevel};

    /// Calls a function with a token of each level.
    fn at_every_level(test: impl Fn(SimdLevel) -> (f32, f32)) {
        for &level in SimdLevel::available() {
            let (worst, allowed) = test(level);
            assert!(worst <= allowed, "{level:?}: off by {worst}, {allowed} allowed");
        }
    }

    struct Angles<'a>(&'a [[f32; 2]], &'a mut Vec<f32>);

    impl Kernel for Angles<'_> {
        type Output = ();

        #[inline(always)]
        fn run<S: Simd>(self, simd: S) {
            for &[y, x] in self.0 {
                let angle: [f32; LANES] = angle(f32x8::splat(simd, y), f32x8::splat(simd, x)).into();
                self.1.push(angle[3]);
            }
        }
    }

    #[test]
    fn angles_are_those_of_the_standard_library() {
        let circle = (0..4096).map(|i| {
            let (sin, cos) = (f64::from(i - 2048) / 2048.0 * std::f64::consts::PI).sin_cos();
            [sin as f32 * 3.0, cos as f32 * 3.0]
        });
        let axes = [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [-1.0, 0.0], [0.0, -1.0]];
        let points: Vec<[f32; 2]> = circle.chain(axes).collect();
        at_every_level(|level| {
            let mut got = Vec::new();
            level.run(Angles(&points, &mut got));
            assert_eq!(got.len(), points.len());
            let off = got.iter().zip(&points).map(|(got, [y, x])| (got - y.atan2(*x)).abs());
            // A step of f32 near pi is 2.4e-7.
            (off.fold(0.0, f32::max), 3e-7)
        });
    }

    struct SinCos<'a>(&'a [f32], &'a mut Vec<[f32; 2]>);

    impl Kernel for SinCos<'_> {
        type Output = ();

        #[inline(always)]
        fn run<S: Simd>(self, simd: S) {
            for &angle in self.0 {
                let (sine, cosine) = sin_cos(f32x8::splat(simd, angle));
                let (sine, cosine): ([f32; LANES], [f32; LANES]) = (sine.into(), cosine.into());
                self.1.push([sine[5], cosine[5]]);
            }
        }
    }

    #[test]
    fn sines_and_cosines_are_those_in_double_precision() {
        let angles: Vec<f32> = (-4000..=4000).map(|i| i as f32 * 1e-3).collect();
        at_every_level(|level| {
            let mut got = Vec::new();
            level.run(SinCos(&angles, &mut got));
            assert_eq!(got.len(), angles.len());
            let off = got.iter().zip(&angles).map(|(got, &angle)| {
                let (sine, cosine) = f64::from(angle).sin_cos();
                (f64::from(got[0]) - sine).abs().max((f64::from(got[1]) - cosine).abs()) as f32
            });
            (off.fold(0.0, f32::max), 2e-7)
        });
    }
}
