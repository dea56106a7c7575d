//! Fits the strengths of terms that are not inputs of a program to its pictures.
//!
//! Light is linear in the strength of each term. If the strengths of a program are unknown, its picture is `known +
//! sum of strength_t * term_t`, and least squares gives the strengths that bring the model nearest to it, for each
//! channel. Two free values per channel hardly ever make a wrong picture right, because they apply to all test
//! scenes.

use crate::testbench::Atlas;
use gonio_render::user_program::NOT_DRAWN;

/// The fitted strengths and the predicted picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// For each term, the strengths for red, green and blue.
    pub strengths: Vec<[f64; 3]>,
    /// The picture of the model with these strengths.
    pub predicted: Atlas,
}

/// The values of a channel at the pixels that count.
pub type Plane = Vec<f32>;

/// The most terms whose strengths are fitted: those of the light equation.
pub const MOST_TERMS: usize = 3;

/// Returns the strengths that bring `known + sum strength * beyond` nearest to `seen`, for one channel. `weights` are those of
/// the values; `beyond` are terms without the known light. A term without values has strength 0.
pub fn weighted_strengths<const TERMS: usize>(
    weights: &[f64],
    seen: &[f32],
    known: &[f32],
    beyond: [&[f32]; TERMS],
) -> [f64; TERMS] {
    let (mut matrix, mut right) = ([[0.0_f64; TERMS]; TERMS], [0.0_f64; TERMS]);
    for (index, ((&weight, &s), &k)) in weights.iter().zip(seen).zip(known).enumerate() {
        let target = f64::from(s - k);
        if !(target.is_finite() && weight > 0.0) {
            continue;
        }
        let here = beyond.map(|term| f64::from(term.get(index).copied().unwrap_or(0.0)));
        if !here.iter().all(|x| x.is_finite()) {
            continue;
        }
        for ((row, right), a) in matrix.iter_mut().zip(&mut right).zip(here) {
            *right += weight * a * target;
            for (sum, b) in row.iter_mut().zip(here) {
                *sum += weight * a * b;
            }
        }
    }
    solve(matrix, right)
}

/// Fits `known + sum strength * term` to `seen`, in the test scenes of `known` and `terms`.
pub fn fit(seen: &Atlas, known: &Atlas, terms: &[Atlas]) -> Fit {
    let is_everywhere = |index: usize, s: &[f32; 4], k: &[f32; 4]| {
        Atlas::is_drawn(s) && Atlas::is_drawn(k) && terms.iter().all(|term| Atlas::is_drawn(&term.pixels[index]))
    };
    let pixels = seen.pixels.iter().zip(&known.pixels).enumerate();
    let counting: Vec<usize> = pixels.filter(|(index, (s, k))| is_everywhere(*index, s, k)).map(|(i, _)| i).collect();
    let of_channel = |channel: usize| {
        let plane = |atlas: &Atlas| -> Plane { counting.iter().map(|&index| atlas.pixels[index][channel]).collect() };
        let (seen, known) = (plane(seen), plane(known));
        let beyond = |term: &Atlas| -> Plane { plane(term).iter().zip(&known).map(|(x, k)| x - k).collect() };
        let beyond: Vec<Plane> = terms.iter().map(beyond).collect();
        // Overexposed pixels are excluded: their value is unknown.
        let weights: Vec<f64> = seen.iter().map(|seen| if *seen < 1.0 { 1.0 } else { 0.0 }).collect();
        let of_term = |term: usize| beyond.get(term).map_or(&[][..], Vec::as_slice);
        weighted_strengths(&weights, &seen, &known, std::array::from_fn::<_, MOST_TERMS, _>(of_term))
    };
    let [red, green, blue] = [0, 1, 2].map(of_channel);
    let found: Vec<[f64; 3]> =
        (0..terms.len().min(MOST_TERMS)).map(|term| [red[term], green[term], blue[term]]).collect();
    let mut predicted = known.clone();
    for (index, pixel) in predicted.pixels.iter_mut().enumerate() {
        if !Atlas::is_drawn(pixel) {
            *pixel = NOT_DRAWN;
            continue;
        }
        let zero = *pixel;
        for (term, strength) in terms.iter().zip(&found) {
            for channel in 0..3 {
                pixel[channel] += strength[channel] as f32 * (term.pixels[index][channel] - zero[channel]);
            }
        }
    }
    Fit { strengths: found, predicted }
}

/// Solves a small symmetric system. Undetermined and negative unknowns become 0.
fn solve<const N: usize>(mut matrix: [[f64; N]; N], mut right: [f64; N]) -> [f64; N] {
    // Terms may differ by twenty orders of magnitude if a vector was not normalised.
    let sizes: [f64; N] = std::array::from_fn(|i| matrix[i][i].sqrt());
    let mut free = sizes.map(|size| size > 1e-6 && size.is_finite());
    let scales: [f64; N] = std::array::from_fn(|i| if free[i] { sizes[i] } else { 1.0 });
    for i in 0..N {
        right[i] /= scales[i];
        for j in 0..N {
            matrix[i][j] /= scales[i] * scales[j];
        }
    }
    loop {
        let (mut of_free, mut right_of_free) = (matrix, right);
        for i in (0..N).filter(|&i| !free[i]) {
            of_free[i].fill(0.0);
            of_free.iter_mut().for_each(|row| row[i] = 0.0);
            of_free[i][i] = 1.0;
            right_of_free[i] = 0.0;
        }
        let solution = eliminate(of_free, right_of_free);
        // Light is not negative: a strength below 0 becomes 0.
        let Some(worst) =
            (0..N).filter(|&i| free[i] && solution[i] < -1e-6).min_by(|&a, &b| solution[a].total_cmp(&solution[b]))
        else {
            return std::array::from_fn(|i| solution[i] / scales[i]);
        };
        free[worst] = false;
    }
}

/// Gaussian elimination with pivoting; rows without a pivot give 0.
fn eliminate<const N: usize>(mut matrix: [[f64; N]; N], mut right: [f64; N]) -> [f64; N] {
    const LEAST: f64 = 1e-12;
    for column in 0..N {
        let size = |row: usize| matrix[row][column].abs();
        let pivot = (column..N).max_by(|&a, &b| size(a).total_cmp(&size(b))).unwrap_or(column);
        if size(pivot) < LEAST {
            continue;
        }
        matrix.swap(column, pivot);
        right.swap(column, pivot);
        for row in (0..N).filter(|&row| row != column) {
            let factor = matrix[row][column] / matrix[column][column];
            let pivot_row = matrix[column];
            matrix[row].iter_mut().zip(pivot_row).for_each(|(to, from)| *to -= factor * from);
            right[row] -= factor * right[column];
        }
    }
    std::array::from_fn(|i| if matrix[i][i].abs() < LEAST { 0.0 } else { right[i] / matrix[i][i] })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn atlas(values: &[f32]) -> Atlas {
        Atlas { pixels: values.iter().map(|&v| [v, 2.0 * v, 0.5 * v, 1.0]).collect() }
    }

    #[test]
    fn strengths_are_recovered() {
        let (known, a, b) = (atlas(&[0.0; 4]), atlas(&[0.1, 0.2, 0.0, 0.1]), atlas(&[0.0, 0.1, 0.3, 0.1]));
        let seen = atlas(&[0.05, 0.18, 0.24, 0.13]); // 0.5 a + 0.8 b
        let fit = fit(&seen, &known, &[a, b]);
        for channel in 0..3 {
            assert!((fit.strengths[0][channel] - 0.5).abs() < 1e-5, "{fit:?}");
            assert!((fit.strengths[1][channel] - 0.8).abs() < 1e-5, "{fit:?}");
        }
        assert!((fit.predicted.pixels[1][0] - 0.18).abs() < 1e-5);
    }

    #[test]
    fn a_missing_term_has_strength_0() {
        let (known, a, b) = (atlas(&[0.0; 3]), atlas(&[0.1, 0.2, 0.3]), atlas(&[0.3, 0.1, 0.1]));
        let seen = atlas(&[0.02, 0.15, 0.25]); // nearest with b at -0.1
        let fit = fit(&seen, &known, &[a, b]);
        assert_eq!(fit.strengths[1], [0.0; 3]);
        assert!(fit.strengths[0][0] > 0.5);
    }
}
