//! Starting points for a lobe about a transformed direction, `f = a / pi + B <-wi^T A wo>^k`.
//!
//! For a known `a` and `k` the root `(f - a / pi)^(1/k)` is linear in the elements of `B^(1/k) A`, which linear least squares
//! finds at once. So all of the range of `k` is tried, with several diffuse parts, and the best few are refined.

use super::target::Point;
use crate::bsdf::mean;
use gonio_light::DVec3;
use std::f64::consts::PI;

/// Exponents that are tried, from 1 to 1000, each a third more than the one before.
const EXPONENTS: usize = 25;
/// Values below this share of the largest are left to the diffuse part.
const LEAST_SHARE: f64 = 1e-3;
/// Starting points that are returned.
const MOST: usize = 4;

/// A lobe with a diffuse part.
#[derive(Clone, Copy, Debug)]
pub(super) struct MatrixLobe {
    /// Diffuse albedo.
    pub a: f64,
    /// The albedo of the lobe, `B 2 pi / (k + 2)` for a matrix whose largest element is 1.
    pub b: f64,
    /// The exponent.
    pub k: f64,
    /// The diagonal of `A`, its largest element 1 or -1.
    pub matrix: DVec3,
}

/// The lobes that fit best, the best first. `diffuse` are the diffuse albedos to try; the elements along the tangent and the
/// bitangent are equal if `is_isotropic`.
pub(super) fn best_lobes(points: &[Point], diffuse: &[f64], is_isotropic: bool) -> Vec<MatrixLobe> {
    let mut found: Vec<(f64, MatrixLobe)> = Vec::new();
    for &a in diffuse {
        for step in 0..EXPONENTS {
            let k = 1000.0_f64.powf(step as f64 / (EXPONENTS - 1) as f64);
            let Some(elements) = regressed(points, a, k, is_isotropic) else { continue };
            let largest = elements.abs().max_element();
            let b = largest.powf(k) * 2.0 * PI / (k + 2.0);
            let error = error(points, a, k, elements);
            if largest > 0.0 && b.is_finite() && error.is_finite() {
                found.push((error, MatrixLobe { a, b, k, matrix: elements / largest }));
            }
        }
    }
    // Of a matte target, only the diffuse part is found.
    let matte =
        MatrixLobe { a: diffuse.first().copied().unwrap_or(0.0), b: 0.01, k: 10.0, matrix: DVec3::new(1.0, 1.0, -1.0) };
    if found.is_empty() {
        return vec![matte];
    }
    found.sort_by(|(a, _), (b, _)| a.total_cmp(b));
    found.into_iter().map(|(_, lobe)| lobe).take(MOST).collect()
}

/// The grey value of a point.
fn grey(point: &Point) -> f64 {
    mean(point.target).powi(3) / point.wi.z
}

/// The products of coordinates that the elements of the matrix multiply.
fn products(point: &Point, is_isotropic: bool) -> DVec3 {
    let all = -point.wi * point.wo;
    if is_isotropic { DVec3::new(all.x + all.y, 0.0, all.z) } else { all }
}

/// The elements of `B^(1/k) A` by linear least squares.
fn regressed(points: &[Point], a: f64, k: f64, is_isotropic: bool) -> Option<DVec3> {
    let largest = points.iter().map(grey).fold(0.0, f64::max);
    // The symmetric matrix and the right side of the normal equations.
    let (mut columns, mut right) = ([DVec3::ZERO; 3], DVec3::ZERO);
    for point in points {
        let f = grey(point) - a / PI;
        if f <= LEAST_SHARE * largest {
            continue;
        }
        // The derivative of the fit's residual, the cube root of light, with respect to the root that is fitted here.
        let weight = k * f.powf(1.0 / 3.0 - 1.0 / k) * point.wi.z.cbrt();
        let row = products(point, is_isotropic) * weight;
        columns[0] += row * row.x;
        columns[1] += row * row.y;
        columns[2] += row * row.z;
        right += row * (weight * f.powf(1.0 / k));
    }
    if is_isotropic {
        columns[1] = DVec3::Y * columns[0].x;
    }
    let [x, y, z] = columns;
    let determinant = x.dot(y.cross(z));
    if determinant.is_nan() || determinant <= 1e-12 * x.x * y.y * z.z {
        return None;
    }
    // Cramer's rule.
    let solved = DVec3::new(right.dot(y.cross(z)), right.dot(z.cross(x)), right.dot(x.cross(y))) / determinant;
    let solved = if is_isotropic { DVec3::new(solved.x, solved.x, solved.z) } else { solved };
    solved.is_finite().then_some(solved)
}

/// The mean square of the fit's residual.
fn error(points: &[Point], a: f64, k: f64, elements: DVec3) -> f64 {
    let sum: f64 = points
        .iter()
        .map(|point| {
            let base = -(point.wi * point.wo).dot(elements);
            let lobe = if base > 0.0 { base.powf(k) } else { 0.0 };
            (((a / PI + lobe) * point.wi.z).cbrt() - mean(point.target)).powi(2)
        })
        .sum();
    sum / points.len() as f64
}
