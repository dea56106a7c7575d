//! Diffuse light of an environment as nine spherical harmonics.
//!
//! A matte surface sees an environment through a cosine lobe, so wide that of the light's variation only the lowest
//! frequencies are left: nine numbers a colour, found once, give the irradiance on every normal by a polynomial of second
//! degree.
//!
//! ```text
//! L_lm = integral over the sphere of  L(w) Y_lm(w) dw
//! E(n) = integral of L(w) <n.w> dw  =  sum over l, m of  A_l L_lm Y_lm(n),   A_0 = pi, A_1 = 2 pi / 3, A_2 = pi / 4
//! ```
//!
//! *Source*: R. Ramamoorthi and P. Hanrahan, *An Efficient Representation for Irradiance Environment Maps*, SIGGRAPH 2001,
//! eqs. (3) to (8) and (10); `x`, `y`, `z` here are the world's, so "up" is `y`, not the paper's `z`: the span of the nine
//! is the same whatever axis is called what.
//! *Limits*: exact for light without frequencies above `l = 2` (and odd ones above it, which the cosine removes). For
//! others the paper gives an average error under 1 %, and 9 % at most for any; about a single small source the worst is
//! 6 % of the largest irradiance, and some of it is negative where there should be none: there it counts as 0.

use crate::Cubemap;
use crate::cubemap::texel_direction;
use crate::face::Face;
use crate::face::SolidAngles;
use crate::panorama::color;
use glam::DVec3;
use gonio_threads::prelude::*;
use std::f64::consts::PI;

/// `sqrt(1 / (4 pi))`, `sqrt(3 / (4 pi))`, and of second degree `sqrt(15 / (4 pi))`, `sqrt(5 / (16 pi))`,
/// `sqrt(15 / (16 pi))`: the factors that make the nine orthonormal over the sphere.
const FACTORS: [f64; 9] = [
    0.282_094_791_773_878_14,
    0.488_602_511_902_919_9,
    0.488_602_511_902_919_9,
    0.488_602_511_902_919_9,
    1.092_548_430_592_079_2,
    1.092_548_430_592_079_2,
    0.315_391_565_252_520_05,
    1.092_548_430_592_079_2,
    0.546_274_215_296_039_6,
];

/// The factor of the cosine lobe for each degree, `A_l` (eq. 8), for each of the nine.
const COSINE: [f64; 9] =
    [PI, 2.0 * PI / 3.0, 2.0 * PI / 3.0, 2.0 * PI / 3.0, PI / 4.0, PI / 4.0, PI / 4.0, PI / 4.0, PI / 4.0];

/// Radiance of an environment, as nine coefficients of spherical harmonics.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Harmonics {
    /// `L_lm` of linear RGB radiance in the order (l, m) = (0, 0), (1, -1), (1, 0), (1, 1), (2, -2), ... (2, 2), which
    /// are the functions 1, y, z, x, xy, yz, 3z^2 - 1, xz, x^2 - y^2 of the world's direction.
    pub coefficients: [DVec3; 9],
}

impl Harmonics {
    /// Projects an environment: each texel is weighted by the solid angle that it covers. Uses all threads; the result
    /// does not depend on how many.
    pub fn from_cubemap(map: &Cubemap) -> Self {
        let size = map.size() as usize;
        let angles = SolidAngles::new(map.size());
        let rows: Vec<[DVec3; 9]> = map
            .pixels()
            .par_chunks_exact(size)
            .enumerate()
            .map(|(index, row)| {
                let (face, y) = (Face::ALL[index / size], index % size);
                let mut sums = [DVec3::ZERO; 9];
                for ((x, pixel), angle) in row.iter().enumerate().zip(angles.row(y)) {
                    let direction = texel_direction(face, x as u32, y as u32, map.size()).normalize();
                    let light = angle * color(*pixel);
                    for (sum, basis) in sums.iter_mut().zip(monomials(direction)) {
                        *sum += basis * light;
                    }
                }
                sums
            })
            .collect();
        // Summed in the order of the rows, whichever thread was first.
        let mut coefficients = [DVec3::ZERO; 9];
        for row in rows {
            for (sum, part) in coefficients.iter_mut().zip(row) {
                *sum += part;
            }
        }
        Harmonics { coefficients: std::array::from_fn(|i| FACTORS[i] * coefficients[i]) }
    }

    /// Returns the nine constants of the polynomial that [`irradiance`] evaluates, for a shader: the product of all
    /// factors that do not depend on the normal.
    pub fn polynomial(&self) -> [DVec3; 9] {
        std::array::from_fn(|i| COSINE[i] * FACTORS[i] * self.coefficients[i])
    }

    /// Returns the irradiance on a surface with this unit normal (in the world), linear RGB: the integral of radiance
    /// times cosine. `pi` under uniform radiance 1. Never negative. If the environment is turned, give the normal
    /// turned back.
    pub fn irradiance(&self, normal: DVec3) -> DVec3 {
        irradiance(&self.polynomial(), normal)
    }

    /// Returns the radiance from a unit direction without the frequencies above `l = 2`; it can be negative.
    pub fn radiance(&self, direction: DVec3) -> DVec3 {
        let basis = monomials(direction);
        (0..9).map(|i| FACTORS[i] * basis[i] * self.coefficients[i]).sum()
    }
}

/// `E(n)` from the nine constants of [`Harmonics::polynomial`], for a unit normal; the shaders' function of the same
/// name does the same.
pub fn irradiance(polynomial: &[DVec3; 9], normal: DVec3) -> DVec3 {
    let sum: DVec3 = polynomial.iter().zip(monomials(normal)).map(|(c, m)| m * *c).sum();
    sum.max(DVec3::ZERO)
}

/// 1, y, z, x, xy, yz, 3z^2 - 1, xz, x^2 - y^2 (eq. 3 without its factors).
fn monomials(d: DVec3) -> [f64; 9] {
    let DVec3 { x, y, z } = d;
    [1.0, y, z, x, x * y, y * z, 3.0 * z * z - 1.0, x * z, x * x - y * y]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nine_are_orthonormal() {
        let size = 64;
        let angles = SolidAngles::new(size);
        let mut products = [[0.0; 9]; 9];
        for face in Face::ALL {
            for y in 0..size {
                for (x, angle) in angles.row(y as usize).enumerate() {
                    let m = monomials(texel_direction(face, x as u32, y, size).normalize());
                    for i in 0..9 {
                        for j in 0..9 {
                            products[i][j] += angle * FACTORS[i] * m[i] * FACTORS[j] * m[j];
                        }
                    }
                }
            }
        }
        for (i, row) in products.iter().enumerate() {
            for (j, product) in row.iter().enumerate() {
                let expected = if i == j { 1.0 } else { 0.0 };
                // A texel's middle stands for the texel: an error of the square of its 0.03.
                assert!((product - expected).abs() < 5e-4, "{i} {j}: {product}");
            }
        }
    }

    #[test]
    fn the_polynomial_is_the_sum() {
        let harmonics = Harmonics { coefficients: std::array::from_fn(|i| DVec3::splat(4.0 - i as f64)) };
        let n = DVec3::new(0.6, 0.48, 0.64);
        let m = monomials(n);
        let expected: f64 = (0..9).map(|i| COSINE[i] * FACTORS[i] * (4.0 - i as f64) * m[i]).sum();
        assert!((harmonics.irradiance(n).x - expected.max(0.0)).abs() < 1e-14 && expected > 0.1);
        // Where the sum is negative there is no light.
        let negative =
            Harmonics { coefficients: std::array::from_fn(|i| if i == 0 { -DVec3::ONE } else { DVec3::ZERO }) };
        assert_eq!(negative.irradiance(n), DVec3::ZERO);
    }
}
