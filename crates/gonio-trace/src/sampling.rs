//! Directions and points from random numbers, each with its density.

use glam::{BVec4A, Vec2, Vec3, Vec4, Vec4Swizzles};
use std::f32::consts::{FRAC_1_PI, FRAC_PI_4, TAU};

/// A point of the unit disc, uniformly: concentric squares to concentric circles (P. Shirley and K. Chiu, *A Low Distortion
/// Map Between Disk and Square*, JGT 2(3), 1997).
#[inline]
pub(crate) fn disc(u: Vec2) -> Vec2 {
    let p = 2.0 * u - Vec2::ONE;
    // Lanes are chosen instead of ways, of which half of the points would take the other.
    let swapped = Vec4::new(p.y, p.x, 0.0, 0.0);
    let is_wide = BVec4A::splat(p.x.abs() > p.y.abs());
    let sorted = Vec4::select(is_wide, Vec4::new(p.x, p.y, 0.0, 0.0), swapped);
    let (long, short) = (sorted.x, sorted.y);
    // In the middle both are 0, and so is the point.
    let (sin, cos) = sin_cos_of_eighth(FRAC_PI_4 * (short / long.abs().max(f32::MIN_POSITIVE).copysign(long)));
    let (along, across) = (long * cos, long * sin);
    Vec4::select(is_wide, Vec4::new(along, across, 0.0, 0.0), Vec4::new(across, along, 0.0, 0.0)).xy()
}

/// Sine and cosine of an angle between -pi/4 and pi/4, within 1e-7 (polynomials of S. L. Moshier, *Methods and Programs for
/// Mathematical Functions*, 1989).
#[inline]
fn sin_cos_of_eighth(angle: f32) -> (f32, f32) {
    let x2 = angle * angle;
    let sin = ((-1.951_529_6e-4 * x2 + 8.332_161e-3) * x2 - 1.666_665_5e-1) * x2 * angle + angle;
    let cos = ((2.443_315_7e-5 * x2 - 1.388_731_6e-3) * x2 + 4.166_664_6e-2) * x2 * x2 - 0.5 * x2 + 1.0;
    (sin, cos)
}

/// A direction about +Z with density [`cosine_density`] (Malley's method).
#[inline]
pub(crate) fn cosine_hemisphere(u: Vec2) -> Vec3 {
    let p = disc(u);
    p.extend((1.0 - p.length_squared()).max(0.0).sqrt())
}

/// `cos / pi`, in 1/sr; 0 from below.
pub(crate) fn cosine_density(cos: f32) -> f32 {
    cos.max(0.0) * FRAC_1_PI
}

/// A direction about +Z with a density proportional to `cos^exponent`: `(exponent + 1) / (2 pi) cos^exponent`.
pub(crate) fn cosine_power(u: Vec2, exponent: f32) -> Vec3 {
    let cos = (1.0 - u.x).powf(1.0 / (exponent + 1.0));
    from_polar(cos, u.y)
}

/// The density of [`cosine_power`], in 1/sr.
pub(crate) fn cosine_power_density(cos: f32, exponent: f32) -> f32 {
    if cos > 0.0 { (exponent + 1.0) / TAU * cos.min(1.0).powf(exponent) } else { 0.0 }
}

/// The direction at the polar angle with this cosine, and at `turn` of a full turn about +Z.
pub(crate) fn from_polar(cos: f32, turn: f32) -> Vec3 {
    let sin = (1.0 - cos * cos).max(0.0).sqrt();
    let (s, c) = (TAU * turn).sin_cos();
    Vec3::new(sin * c, sin * s, cos)
}

/// Barycentric coordinates of a point of a triangle, uniformly over its area, with little distortion (E. Heitz, *A
/// Low-Distortion Map Between Triangle and Square*, 2019).
#[inline]
pub(crate) fn triangle(u: Vec2) -> Vec3 {
    // In both halves of the square: the smaller coordinate is halved, and the other loses as much.
    let half = 0.5 * u.x.min(u.y);
    let (b0, b1) = (u.x - half, u.y - half);
    Vec3::new(b0, b1, 1.0 - b0 - b1)
}

/// Point `i` of a sequence that fills the unit square evenly (M. Roberts, *The Unreasonable Effectiveness of Quasirandom
/// Sequences*, 2018).
pub(crate) fn r2(i: u32) -> Vec2 {
    let at = |step: f64| (0.5 + step * f64::from(i + 1)).fract() as f32;
    Vec2::new(at(0.754_877_666_246_692_8), at(0.569_840_290_998_053_3))
}

/// Veach's power heuristic with exponent 2: the weight of a sample of density `a` where another technique has density
/// `b` (E. Veach, *Robust Monte Carlo Methods for Light Transport Simulation*, 1997, section 9.2.2).
#[inline]
pub(crate) fn power_heuristic(a: f32, b: f32) -> f32 {
    if a.is_infinite() {
        return 1.0;
    }
    let ratio = b / a;
    1.0 / (1.0 + ratio * ratio)
}

/// Chooses an index with a probability proportional to its weight.
#[derive(Clone, Debug, Default)]
pub(crate) struct Discrete {
    /// Sums of the weights up to and including each, divided by their sum.
    cumulative: Vec<f32>,
    /// The sum of the weights.
    pub total: f64,
}

impl Discrete {
    /// Weights that are negative or not finite count as 0.
    pub fn new(weights: impl IntoIterator<Item = f64>) -> Self {
        let mut sums = Vec::new();
        let mut total = 0.0;
        for weight in weights {
            total += if weight.is_finite() { weight.max(0.0) } else { 0.0 };
            sums.push(total);
        }
        let scale = if total > 0.0 { 1.0 / total } else { 0.0 };
        Discrete { cumulative: sums.into_iter().map(|s| (s * scale) as f32).collect(), total }
    }

    /// No index has a weight.
    pub fn is_empty(&self) -> bool {
        self.total <= 0.0
    }

    /// The probability of an index.
    #[inline]
    pub fn probability(&self, index: usize) -> f32 {
        let below = if index == 0 { 0.0 } else { self.cumulative[index - 1] };
        self.cumulative[index] - below
    }

    /// The index at `u` in `[0, 1)`, its probability, and `u` stretched to `[0, 1)` again within the index. `None` where
    /// nothing has a weight.
    #[inline]
    pub fn sample(&self, u: f32) -> Option<(usize, f32, f32)> {
        if self.is_empty() {
            return None;
        }
        // Counting the few takes no branches.
        let below = match self.cumulative.len() {
            0..=8 => self.cumulative.iter().map(|&c| usize::from(c <= u)).sum(),
            _ => self.cumulative.partition_point(|&c| c <= u),
        };
        let index = below.min(self.cumulative.len() - 1);
        let probability = self.probability(index);
        let below = self.cumulative[index] - probability;
        // At the very end rounding may choose an index without weight; it is then left out.
        (probability > 0.0)
            .then(|| (index, probability, ((u - below) / probability).clamp(0.0, 1.0 - f32::EPSILON / 2.0)))
    }
}

/// Two unit vectors that make a right-handed frame with the unit vector `n` (T. Duff et al., *Building an Orthonormal Basis,
/// Revisited*, JCGT 6(1), 2017).
#[inline]
pub(crate) fn frame(n: Vec3) -> (Vec3, Vec3) {
    n.any_orthonormal_pair()
}
