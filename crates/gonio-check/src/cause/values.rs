//! The values of an expression at all points, and how two of them are related.

use std::sync::OnceLock;

/// The values of a quantity at all points, component by component within each point. Points at which it is not computed
/// are absent.
#[derive(Clone, Debug, PartialEq)]
pub struct Values {
    /// Components of each point: 1 for a `float`, 16 for a `mat4`.
    pub size: usize,
    /// `size` numbers for each point; NaN at absent points.
    pub numbers: Vec<f32>,
    /// Whether each point has a value.
    pub present: Vec<bool>,
    root_mean_square: OnceLock<f32>,
    is_constant: OnceLock<bool>,
}

/// The largest difference between numbers that count as the same, in parts of the root mean square.
const TOLERANCE: f32 = 2e-3;
/// Fewer points than these prove nothing.
const FEWEST: usize = 8;
/// The share of points that may differ: places on a silhouette, where rounding decides.
const MOST_DIFFERENT: f32 = 0.01;

impl Values {
    /// Creates values that no point has.
    #[must_use]
    pub fn absent(size: usize, points: usize) -> Self {
        Values {
            size,
            numbers: vec![f32::NAN; size * points],
            present: vec![false; points],
            root_mean_square: OnceLock::new(),
            is_constant: OnceLock::new(),
        }
    }

    /// Creates values that all points have; `numbers` has `size` for each point.
    #[must_use]
    pub fn new(size: usize, numbers: Vec<f32>) -> Self {
        let points = numbers.len().checked_div(size).unwrap_or(0);
        Values {
            size,
            numbers,
            present: vec![true; points],
            root_mean_square: OnceLock::new(),
            is_constant: OnceLock::new(),
        }
    }

    /// The values of the first points.
    #[must_use]
    pub fn first(&self, points: usize) -> Self {
        let points = points.min(self.points());
        Values {
            size: self.size,
            numbers: self.numbers[..points * self.size].to_vec(),
            present: self.present[..points].to_vec(),
            root_mean_square: OnceLock::new(),
            is_constant: OnceLock::new(),
        }
    }

    /// The values of some points, by their numbers here.
    #[must_use]
    pub fn some(&self, points: &[usize]) -> Self {
        let mut made = Values::absent(self.size, points.len());
        for (to, from) in points.iter().enumerate() {
            made.present[to] = self.present[*from];
            made.numbers[to * self.size..][..self.size].copy_from_slice(self.at(*from));
        }
        made
    }

    /// The number of points.
    #[must_use]
    pub fn points(&self) -> usize {
        self.present.len()
    }

    /// The numbers of a point.
    #[must_use]
    pub fn at(&self, point: usize) -> &[f32] {
        &self.numbers[point * self.size..][..self.size]
    }

    /// Creates values from those of each point.
    #[must_use]
    pub fn map(&self, size: usize, mut f: impl FnMut(usize, &[f32], &mut [f32])) -> Self {
        let mut made = Values::absent(size, self.points());
        made.present.clone_from(&self.present);
        for point in 0..self.points() {
            f(point, self.at(point), &mut made.numbers[point * size..][..size]);
        }
        made
    }

    /// The products with other values; a single number of these multiplies each component.
    #[must_use]
    pub fn times(&self, other: &Values) -> Values {
        self.map(self.size, |point, from, to| {
            let other = other.at(point);
            let numbers = to.iter_mut().zip(from).enumerate();
            numbers.for_each(|(c, (to, from))| *to = from * other[c.min(other.len() - 1)]);
        })
    }

    /// Whether the others are the products of these with a factor.
    #[must_use]
    pub fn is_factor_of(&self, factor: &Values, others: &Values) -> bool {
        self.size == others.size && factor.size <= self.size && self.times(factor).is_same(others)
    }

    /// The root mean square of all present numbers; 0 if there are none.
    #[must_use]
    pub fn root_mean_square(&self) -> f32 {
        *self.root_mean_square.get_or_init(|| self.compute_root_mean_square())
    }

    fn compute_root_mean_square(&self) -> f32 {
        let (mut sum, mut count) = (0.0_f64, 0_u32);
        let present = (0..self.points()).filter(|point| self.present[*point]);
        for x in present.flat_map(|point| self.at(point)).filter(|x| x.is_finite()) {
            sum += f64::from(*x) * f64::from(*x);
            count += 1;
        }
        if count == 0 { 0.0 } else { (sum / f64::from(count)).sqrt() as f32 }
    }

    /// Whether there is a value wherever the other one has one: a part of `?:` has none where the other part counts.
    #[must_use]
    pub fn covers(&self, other: &Values) -> bool {
        self.present.iter().zip(&other.present).all(|(own, other)| *own || !other)
    }

    /// Whether both are the same at the points that have both.
    #[must_use]
    pub fn is_same(&self, other: &Values) -> bool {
        self.is_scaled(other, 1.0)
    }

    /// Whether these are `factor` times the others.
    #[must_use]
    pub fn is_scaled(&self, other: &Values, factor: f32) -> bool {
        let tolerance = TOLERANCE * (other.root_mean_square() * factor.abs()).max(1e-4);
        self.agrees(other, |a, b| is_near(a, b, factor, tolerance))
    }

    /// Whether both are the same at the points of the others, which are the first of these.
    #[must_use]
    pub fn is_same_of_first(&self, other: &Values) -> bool {
        let tolerance = TOLERANCE * other.root_mean_square().max(1e-4);
        let points = other.points().min(self.points());
        let mut different = 0;
        self.size == other.size
            && points >= FEWEST
            && (0..points).filter(|point| self.present[*point] && other.present[*point]).all(|point| {
                different += usize::from(!is_near(self.at(point), other.at(point), 1.0, tolerance));
                different * 100 <= points
            })
    }

    /// Whether a relation holds at the points that have both, up to a few.
    pub fn agrees(&self, other: &Values, mut holds: impl FnMut(&[f32], &[f32]) -> bool) -> bool {
        if self.size != other.size || self.points() != other.points() {
            return false;
        }
        let most = (MOST_DIFFERENT * self.points() as f32) as usize;
        let (mut both, mut different) = (0_usize, 0_usize);
        for point in 0..self.points() {
            if self.present[point] && other.present[point] {
                both += 1;
                different += usize::from(!holds(self.at(point), other.at(point)));
                // Most pairs differ at the first points.
                if different > most {
                    return false;
                }
            }
        }
        both >= FEWEST.min(self.points()) && different as f32 <= MOST_DIFFERENT * both as f32
    }

    /// The constant by which these are a multiple of the others; `None` if there is none.
    #[must_use]
    pub fn factor_of(&self, other: &Values) -> Option<f32> {
        if self.size != other.size || self.points() != other.points() {
            return None;
        }
        let both = (0..self.points()).filter(|point| self.present[*point] && other.present[*point]);
        let pairs = both.flat_map(|point| self.at(point).iter().zip(other.at(point)));
        let first = pairs.filter(|(a, b)| a.is_finite() && b.is_finite()).take(64);
        let (a, b) = first.max_by(|x, y| x.1.abs().total_cmp(&y.1.abs()))?;
        let factor = Some(a / b).filter(|factor| factor.is_finite() && factor.abs() > 1e-4)?;
        self.is_scaled(other, factor).then_some(factor)
    }

    /// Whether the vectors point in the same direction at all points (`sign` 1) or in the opposite one (-1), whatever
    /// their lengths.
    #[must_use]
    pub fn is_parallel(&self, other: &Values, sign: f32) -> bool {
        let length = |v: &[f32]| v.iter().map(|x| x * x).sum::<f32>().sqrt();
        self.size == 3
            && self.agrees(other, |a, b| {
                let lengths = length(a) * length(b);
                let dot: f32 = a.iter().zip(b).map(|(a, b)| a * b).sum();
                let sine = [[1, 2], [2, 0], [0, 1]].map(|[i, j]| a[i] * b[j] - a[j] * b[i]);
                dot * sign > 0.0 && length(&sine) <= TOLERANCE * lengths
            })
    }

    /// Whether one is the other, clamped at 0.
    #[must_use]
    pub fn is_clamped(&self, other: &Values) -> bool {
        let tolerance = TOLERANCE * self.root_mean_square().max(other.root_mean_square()).max(1e-4);
        self.size == 1 && self.agrees(other, |a, b| (a[0].max(0.0) - b[0].max(0.0)).abs() <= tolerance)
    }

    /// Whether these numbers are 1 over the others.
    #[must_use]
    pub fn is_reciprocal(&self, other: &Values) -> bool {
        self.size == 1 && self.agrees(other, |a, b| (a[0] * b[0] - 1.0).abs() <= TOLERANCE)
    }

    /// Whether these are a multiple of the others plus a constant that is not 0.
    #[must_use]
    pub fn is_affine_of(&self, other: &Values) -> bool {
        let pairs = || self.numbers.iter().zip(&other.numbers).filter(|(a, b)| a.is_finite() && b.is_finite()).take(64);
        let low = pairs().min_by(|x, y| x.1.total_cmp(y.1));
        let high = pairs().max_by(|x, y| x.1.total_cmp(y.1));
        let (Some((a0, b0)), Some((a1, b1))) = (low, high) else { return false };
        let slope = (a1 - a0) / (b1 - b0);
        let constant = a0 - slope * b0;
        let is_one = self.size == 1 && slope.is_finite() && slope.abs() > 1e-3 && constant.abs() > 1e-3;
        is_one && self.is_same(&other.map(1, |_, b, to| to[0] = slope * b[0] + constant))
    }

    /// Whether these are a power of the others, with a constant exponent.
    #[must_use]
    pub fn is_power_of(&self, other: &Values) -> bool {
        let is_inside = |x: f32| x > 0.05 && x < 0.95;
        let found = (self.numbers.iter().zip(&other.numbers)).find(|(a, b)| is_inside(**a) && is_inside(**b));
        let Some((a, b)) = found else { return false };
        let exponent = a.ln() / b.ln();
        self.size == 1 && self.is_same(&other.map(1, |_, b, to| to[0] = b[0].max(0.0).powf(exponent)))
    }

    /// The numbers of colours whose channels are all equal; `None` for others.
    #[must_use]
    pub fn grey(&self) -> Option<Values> {
        let is_grey = |point: usize| {
            let at = self.at(point);
            !self.present[point] || at.iter().all(|x| *x == at[0])
        };
        (self.size == 3 && (0..self.points()).all(is_grey)).then(|| self.map(1, |_, from, to| to[0] = from[0]))
    }

    /// The vectors with length 1.
    #[must_use]
    pub fn unit(&self) -> Values {
        self.map(self.size, |_, from, to| {
            let length = from.iter().map(|x| x * x).sum::<f32>().sqrt();
            to.iter_mut().zip(from).for_each(|(to, from)| *to = from / length);
        })
    }

    /// Whether all points have the same numbers.
    #[must_use]
    pub fn is_constant(&self) -> bool {
        *self.is_constant.get_or_init(|| self.compute_is_constant())
    }

    fn compute_is_constant(&self) -> bool {
        let mut present = (0..self.points()).filter(|point| self.present[*point]);
        let Some(first) = present.next() else { return true };
        let tolerance = TOLERANCE * self.root_mean_square().max(1e-4);
        present.all(|point| is_near(self.at(point), self.at(first), 1.0, tolerance))
    }
}

fn is_near(a: &[f32], b: &[f32], factor: f32, tolerance: f32) -> bool {
    a.iter().zip(b).all(|(a, b)| {
        let b = b * factor;
        // Both are infinite or not a number where an exact answer has none.
        (a - b).abs() <= tolerance + TOLERANCE * b.abs() || (!a.is_finite() && !b.is_finite())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn vectors(of: impl Fn(usize) -> [f32; 3]) -> Values {
        Values::new(3, (0..64).flat_map(of).collect())
    }

    #[test]
    fn relations_are_recognised() {
        let a = vectors(|i| [(i as f32 * 0.7).sin(), 1.0, (i as f32 * 0.3).cos()]);
        let twice = vectors(|i| [(i as f32 * 0.7).sin() * -2.0, -2.0, (i as f32 * 0.3).cos() * -2.0]);
        let longer = a.map(3, |i, from, to| to.iter_mut().zip(from).for_each(|(t, f)| *t = f * (1.0 + i as f32)));
        assert!(a.is_same(&a) && !a.is_same(&twice) && !a.is_same(&longer));
        assert!((twice.factor_of(&a).unwrap() + 2.0).abs() < 1e-4);
        assert_eq!(longer.factor_of(&a), None);
        assert!(longer.is_parallel(&a, 1.0) && twice.is_parallel(&a, -1.0) && !twice.is_parallel(&a, 1.0));
        assert!(a.unit().is_same(&longer.unit()));
        assert!(!a.is_constant() && vectors(|_| [1.0, 2.0, 3.0]).is_constant());
    }

    #[test]
    fn few_different_points_are_accepted_and_many_are_not() {
        let a = Values::new(1, (0..600).map(|i| i as f32).collect());
        let mut b = a.clone();
        b.numbers[17] = -400.0;
        assert!(a.is_same(&b));
        (0..30).for_each(|i| b.numbers[i * 20] = -400.0);
        assert!(!a.is_same(&b));
        assert!(!a.is_same(&Values::absent(1, 600)));
    }
}
