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
const MOST_TERMS: usize = 3;

/// Returns the strengths that bring `known + sum strength * beyond` nearest to `seen`, for one channel. `weight` is that of
/// each value; `beyond` are at most three terms without the known light.
pub fn weighted_strengths(weight: impl Fn(usize) -> f64, seen: &[f32], known: &[f32], beyond: &[&[f32]]) -> Vec<f64> {
    let count = beyond.len().min(MOST_TERMS);
    let (mut matrix, mut right) = ([0.0_f64; MOST_TERMS * MOST_TERMS], [0.0_f64; MOST_TERMS]);
    for (index, (&s, &k)) in seen.iter().zip(known).enumerate() {
        let weight = weight(index);
        let target = f64::from(s - k);
        if !(target.is_finite() && weight > 0.0) {
            continue;
        }
        let mut here = [0.0_f64; MOST_TERMS];
        for (value, term) in here.iter_mut().zip(beyond) {
            *value = f64::from(term.get(index).copied().unwrap_or(f32::NAN));
        }
        let here = &here[..count];
        if !here.iter().all(|x| x.is_finite()) {
            continue;
        }
        for (row, a) in here.iter().enumerate() {
            right[row] += weight * a * target;
            for (sum, b) in matrix[row * count..].iter_mut().zip(here) {
                *sum += weight * a * b;
            }
        }
    }
    solve(matrix[..count * count].to_vec(), right[..count].to_vec())
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
        let beyond: Vec<&[f32]> = beyond.iter().map(Vec::as_slice).collect();
        // Overexposed pixels are excluded: their value is unknown.
        weighted_strengths(|index| if seen[index] < 1.0 { 1.0 } else { 0.0 }, &seen, &known, &beyond)
    };
    let [red, green, blue] = [0, 1, 2].map(of_channel);
    let found: Vec<[f64; 3]> = red.iter().zip(green).zip(blue).map(|((r, g), b)| [*r, g, b]).collect();
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
fn solve(mut matrix: Vec<f64>, mut right: Vec<f64>) -> Vec<f64> {
    let count = right.len();
    // Terms may differ by twenty orders of magnitude if a vector was not normalised.
    let sizes: Vec<f64> = (0..count).map(|i| matrix[i * count + i].sqrt()).collect();
    let mut free: Vec<bool> = sizes.iter().map(|&size| size > 1e-6 && size.is_finite()).collect();
    let scale = |i: usize| if free[i] { sizes[i] } else { 1.0 };
    for i in 0..count {
        right[i] /= scale(i);
        for j in 0..count {
            matrix[i * count + j] /= scale(i) * scale(j);
        }
    }
    let scales: Vec<f64> = (0..count).map(scale).collect();
    let unscaled = |solution: Vec<f64>| solution.into_iter().zip(&scales).map(|(x, scale)| x / scale).collect();
    let (matrix_kept, right_kept) = (matrix.clone(), right.clone());
    loop {
        matrix.copy_from_slice(&matrix_kept);
        right.copy_from_slice(&right_kept);
        for i in (0..count).filter(|&i| !free[i]) {
            for j in 0..count {
                matrix[i * count + j] = 0.0;
                matrix[j * count + i] = 0.0;
            }
            matrix[i * count + i] = 1.0;
            right[i] = 0.0;
        }
        let solution = eliminate(&mut matrix, &mut right);
        // Light is not negative: a strength below 0 becomes 0.
        let Some(worst) =
            (0..count).filter(|&i| free[i] && solution[i] < -1e-6).min_by(|&a, &b| solution[a].total_cmp(&solution[b]))
        else {
            return unscaled(solution);
        };
        free[worst] = false;
    }
}

/// Gaussian elimination with pivoting; rows without a pivot give 0.
fn eliminate(matrix: &mut [f64], right: &mut [f64]) -> Vec<f64> {
    let count = right.len();
    for column in 0..count {
        let pivot = (column..count)
            .max_by(|&a, &b| matrix[a * count + column].abs().total_cmp(&matrix[b * count + column].abs()))
            .unwrap_or(column);
        if matrix[pivot * count + column].abs() < 1e-12 {
            continue;
        }
        for j in 0..count {
            matrix.swap(column * count + j, pivot * count + j);
        }
        right.swap(column, pivot);
        for row in (0..count).filter(|&row| row != column) {
            let factor = matrix[row * count + column] / matrix[column * count + column];
            for j in 0..count {
                matrix[row * count + j] -= factor * matrix[column * count + j];
            }
            right[row] -= factor * right[column];
        }
    }
    (0..count)
        .map(|i| if matrix[i * count + i].abs() < 1e-12 { 0.0 } else { right[i] / matrix[i * count + i] })
        .collect()
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
