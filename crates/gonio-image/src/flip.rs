//! FLIP: how different two pictures look where one replaces the other on a screen.
//!
//! P. Andersson et al., *FLIP: A Difference Evaluator for Alternating Images*, 2020, for pictures of low dynamic range. Each value
//! is between 0, equal, and 1, as different as a screen can show:
//!
//! ```text
//! FLIP = dE_c ^ (1 - dE_f)
//! ```
//!
//! `dE_c` is the difference of colours after the filter that the eye has at this distance from the screen, `dE_f` that of edges
//! and points. Swapping the pictures changes nothing.

use rayon::prelude::*;
use std::f32::consts::PI;

/// Pixels per degree of the visual angle: a screen of 3840 pixels and 0.7 m width, seen from 0.7 m, as in the paper.
pub const PIXELS_PER_DEGREE: f32 = 0.7 * 3840.0 / 0.7 * PI / 180.0;

/// Exponent of a difference of colours (`q_c`).
const COLOR_EXPONENT: f32 = 0.7;
/// Exponent of a difference of features (`q_f`).
const FEATURE_EXPONENT: f32 = 0.5;
/// Up to this share of the largest difference (`p_c`) ...
const KNEE: f32 = 0.4;
/// ... differences are mapped to this share of the result (`p_t`).
const KNEE_RESULT: f32 = 0.95;
/// Width of a detected feature in degrees (`w`).
const FEATURE_WIDTH: f32 = 0.082;

/// Gaussians `a sqrt(pi / b) exp(-pi^2 x^2 / b)`, x in degrees: the contrast sensitivity of lightness, red-green and blue-yellow.
const SENSITIVITY: [[(f32, f32); 2]; 3] =
    [[(1.0, 0.0047), (0.0, 1e-5)], [(1.0, 0.0053), (0.0, 1e-5)], [(34.1, 0.04), (13.5, 0.025)]];

/// Linear sRGB to CIE XYZ (IEC 61966-2-1); the rows' sums are the white point.
const XYZ_FROM_RGB: [[f32; 3]; 3] = [
    [0.412_456_4, 0.357_576_1, 0.180_437_5],
    [0.212_672_9, 0.715_152_2, 0.072_175],
    [0.019_333_9, 0.119_192, 0.950_304_1],
];
const RGB_FROM_XYZ: [[f32; 3]; 3] = [
    [3.240_454_2, -1.537_138_5, -0.498_531_4],
    [-0.969_266, 1.876_010_8, 0.041_556],
    [0.055_643_4, -0.204_025_9, 1.057_225_2],
];

/// One channel of a picture.
type Plane = Vec<f32>;

/// The FLIP value of every pixel of two pictures of `width * height` pixels: linear sRGB as displayed, in `[0, 1]`; values beyond
/// are clamped, NaN is black. Pixels that only one picture has are left out.
pub fn flip(width: usize, a: &[[f32; 3]], b: &[[f32; 3]], pixels_per_degree: f32) -> Vec<f32> {
    let width = width.max(1);
    let height = a.len().min(b.len()) / width;
    let (a, b) = (&a[..width * height], &b[..width * height]);
    let ppd = if pixels_per_degree.is_finite() { pixels_per_degree.max(1.0) } else { PIXELS_PER_DEGREE };
    let ([color_a, color_b], [features_a, features_b]) =
        rayon::join(|| [a, b].map(|p| perceived(width, p, ppd)), || [a, b].map(|p| features(width, p, ppd)));
    let most = hyab(hunt(lab([0.0, 1.0, 0.0])), hunt(lab([0.0, 0.0, 1.0]))).powf(COLOR_EXPONENT);
    (0..width * height)
        .into_par_iter()
        .map(|i| {
            let color = redistributed(hyab(color_a[i], color_b[i]).powf(COLOR_EXPONENT), most);
            let [(edge_a, point_a), (edge_b, point_b)] = [features_a[i], features_b[i]];
            let feature = (edge_a - edge_b).abs().max((point_a - point_b).abs()) * std::f32::consts::FRAC_1_SQRT_2;
            color.powf(1.0 - feature.powf(FEATURE_EXPONENT).min(1.0)).clamp(0.0, 1.0)
        })
        .collect()
}

/// The mean of [`flip()`] over all pixels, the usual single number; 0 of pictures without pixels.
pub fn mean(values: &[f32]) -> f64 {
    values.iter().map(|&v| f64::from(v)).sum::<f64>() / values.len().max(1) as f64
}

fn times(matrix: &[[f32; 3]; 3], v: [f32; 3]) -> [f32; 3] {
    matrix.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

/// XYZ relative to the white point.
fn relative_xyz(rgb: [f32; 3]) -> [f32; 3] {
    let white = times(&XYZ_FROM_RGB, [1.0; 3]);
    let xyz = times(&XYZ_FROM_RGB, rgb.map(|v| if v > 0.0 { v.min(1.0) } else { 0.0 }));
    std::array::from_fn(|i| xyz[i] / white[i])
}

/// Linear opponent colours YCxCz.
fn opponent(rgb: [f32; 3]) -> [f32; 3] {
    let [x, y, z] = relative_xyz(rgb);
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

fn rgb_of_opponent([lightness, cx, cz]: [f32; 3]) -> [f32; 3] {
    let white = times(&XYZ_FROM_RGB, [1.0; 3]);
    let y = (lightness + 16.0) / 116.0;
    times(&RGB_FROM_XYZ, [(y + cx / 500.0) * white[0], y * white[1], (y - cz / 200.0) * white[2]])
}

/// CIE L*a*b* (1976).
fn lab(rgb: [f32; 3]) -> [f32; 3] {
    const DELTA: f32 = 6.0 / 29.0;
    let f = |t: f32| if t > DELTA * DELTA * DELTA { t.cbrt() } else { t / (3.0 * DELTA * DELTA) + 4.0 / 29.0 };
    let [x, y, z] = relative_xyz(rgb).map(f);
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

/// The Hunt effect: colours of bright places look more saturated.
fn hunt([lightness, a, b]: [f32; 3]) -> [f32; 3] {
    [lightness, 0.01 * lightness * a, 0.01 * lightness * b]
}

/// The HyAB distance (S. Abasi et al. 2020).
fn hyab(a: [f32; 3], b: [f32; 3]) -> f32 {
    (a[0] - b[0]).abs() + (a[1] - b[1]).hypot(a[2] - b[2])
}

/// Maps a difference to `[0, 1]`; `most` is the largest one.
fn redistributed(difference: f32, most: f32) -> f32 {
    let knee = KNEE * most;
    if difference < knee {
        KNEE_RESULT / knee * difference
    } else {
        KNEE_RESULT + (difference - knee) / (most - knee) * (1.0 - KNEE_RESULT)
    }
}

/// The colours that the eye sees, with the Hunt effect.
fn perceived(width: usize, rgb: &[[f32; 3]], ppd: f32) -> Vec<[f32; 3]> {
    let channels: Vec<[f32; 3]> = rgb.par_iter().map(|&p| opponent(p)).collect();
    let widest = SENSITIVITY.as_flattened().iter().map(|g| g.1).fold(0.0, f32::max);
    let radius = (3.0 * (widest / (2.0 * PI * PI)).sqrt() * ppd).ceil() as usize;
    let planes: Vec<Plane> = (0..3)
        .into_par_iter()
        .map(|c| {
            let plane: Plane = channels.iter().map(|p| p[c]).collect();
            let mut sum = vec![0.0; plane.len()];
            let mut total = 0.0;
            for (a, b) in SENSITIVITY[c].into_iter().filter(|g| g.0 > 0.0) {
                let kernel = kernel(radius, |x| (-(PI * x / ppd).powi(2) / b).exp());
                let weight = a * (PI / b).sqrt();
                total += weight * kernel.iter().sum::<f32>().powi(2);
                for (sum, v) in sum.iter_mut().zip(filtered(width, &plane, &kernel, &kernel)) {
                    *sum += weight * v;
                }
            }
            sum.iter_mut().for_each(|v| *v /= total);
            sum
        })
        .collect();
    (0..rgb.len())
        .into_par_iter()
        .map(|i| hunt(lab(rgb_of_opponent([planes[0][i], planes[1][i], planes[2][i]]))))
        .collect()
}

/// How strong an edge and a point are at each pixel.
fn features(width: usize, rgb: &[[f32; 3]], ppd: f32) -> Vec<(f32, f32)> {
    let grey: Plane = rgb.par_iter().map(|&p| relative_xyz(p)[1]).collect();
    let deviation = 0.5 * FEATURE_WIDTH * ppd;
    let radius = (3.0 * deviation).ceil() as usize;
    let gauss = |x: f32| (-x * x / (2.0 * deviation * deviation)).exp();
    let smooth = balanced(kernel(radius, gauss));
    let edge = balanced(kernel(radius, |x| -x * gauss(x)));
    let point = balanced(kernel(radius, |x| (x * x / (deviation * deviation) - 1.0) * gauss(x)));
    let strength = |along: &[f32]| {
        let (x, y) = rayon::join(|| filtered(width, &grey, along, &smooth), || filtered(width, &grey, &smooth, along));
        x.into_iter().zip(y).map(|(x, y)| x.hypot(y)).collect::<Plane>()
    };
    let (edges, points) = rayon::join(|| strength(&edge), || strength(&point));
    edges.into_iter().zip(points).collect()
}

fn kernel(radius: usize, value: impl Fn(f32) -> f32) -> Vec<f32> {
    (0..=2 * radius).map(|i| value(i as f32 - radius as f32)).collect()
}

/// The kernel with its positive weights scaled to a sum of 1, and its negative ones to a sum of -1.
fn balanced(kernel: Vec<f32>) -> Vec<f32> {
    let sum = |sign: f32| kernel.iter().map(|v| (v * sign).max(0.0)).sum::<f32>().max(f32::MIN_POSITIVE);
    let (positive, negative) = (sum(1.0), sum(-1.0));
    kernel.into_iter().map(|v| if v > 0.0 { v / positive } else { v / negative }).collect()
}

/// The convolution with `rows` along the rows and `columns` along the columns; beyond its edges the picture goes on as at them.
fn filtered(width: usize, plane: &[f32], rows: &[f32], columns: &[f32]) -> Plane {
    let height = plane.len() / width;
    let weighted = |kernel: &[f32], at: usize, length: usize, value: &dyn Fn(usize) -> f32| -> f32 {
        let radius = kernel.len() / 2;
        kernel.iter().enumerate().map(|(k, w)| w * value((at + k).saturating_sub(radius).min(length - 1))).sum()
    };
    let mut across = vec![0.0; plane.len()];
    across.par_chunks_mut(width).zip(plane.par_chunks(width)).for_each(|(to, from)| {
        for (x, to) in to.iter_mut().enumerate() {
            *to = weighted(rows, x, width, &|x| from[x]);
        }
    });
    let mut both = vec![0.0; plane.len()];
    both.par_chunks_mut(width).enumerate().for_each(|(y, to)| {
        for (x, to) in to.iter_mut().enumerate() {
            *to = weighted(columns, y, height, &|y| across[y * width + x]);
        }
    });
    both
}

#[cfg(test)]
mod tests {
    use super::*;

    const WIDTH: usize = 40;

    fn plain(rgb: [f32; 3]) -> Vec<[f32; 3]> {
        vec![rgb; WIDTH * 30]
    }

    fn pattern(shift: usize) -> Vec<[f32; 3]> {
        (0..WIDTH * 30)
            .map(|i| {
                let (x, y) = (i % WIDTH + shift, i / WIDTH);
                [(x * 37 % 11) as f32 / 10.0, (y * 13 % 7) as f32 / 6.0, ((x + y) % 5) as f32 / 4.0]
            })
            .collect()
    }

    #[test]
    fn equal_pictures_have_no_difference_and_order_does_not_matter() {
        let (a, b) = (pattern(0), pattern(1));
        assert!(flip(WIDTH, &a, &a, PIXELS_PER_DEGREE).iter().all(|&v| v == 0.0));
        let (ab, ba) = (flip(WIDTH, &a, &b, PIXELS_PER_DEGREE), flip(WIDTH, &b, &a, PIXELS_PER_DEGREE));
        assert_eq!(ab, ba);
        assert!(ab.iter().all(|v| (0.0..=1.0).contains(v)) && mean(&ab) > 0.05, "{}", mean(&ab));
    }

    /// Plain pictures have no features, and no filter changes them: the value follows from the formulas of colours alone.
    #[test]
    fn plain_colours_have_the_values_of_the_formulas() {
        let between = |a, b| {
            let values = flip(WIDTH, &plain(a), &plain(b), PIXELS_PER_DEGREE);
            assert!(values.iter().all(|v| (v - values[0]).abs() < 1e-3), "the value is not the same everywhere");
            values[WIDTH * 15 + 20]
        };
        // The pair that defines the largest difference.
        assert!((between([0.0, 1.0, 0.0], [0.0, 0.0, 1.0]) - 1.0).abs() < 1e-3);
        // Black and white are 100 apart: 100^0.7 = 25.12; green and blue are 308.5^0.7 = 55.27 apart, and 0.4 of it is 22.11,
        // so the value is 0.95 + 0.05 (25.12 - 22.11) / (55.27 - 22.11), with 308.5 by the Lab values of both colours.
        let most = hyab(hunt(lab([0.0, 1.0, 0.0])), hunt(lab([0.0, 0.0, 1.0])));
        let (green, blue) = ([87.735, -86.183, 83.18], [32.297, 79.188, -107.86]);
        assert!((most - hyab(hunt(green), hunt(blue))).abs() < 0.3, "{most}");
        let expected = redistributed(100.0_f32.powf(0.7), hyab(hunt(green), hunt(blue)).powf(0.7));
        let found = between([0.0; 3], [1.0; 3]);
        assert!((found - expected).abs() < 2e-3 && found > 0.95, "{found}, {expected}");
    }

    #[test]
    fn noise_that_the_eye_blurs_counts_less_than_a_shift_of_colour() {
        let grey = plain([0.2; 3]);
        let checker = |amount: f32| -> Vec<[f32; 3]> {
            (0..grey.len())
                .map(|i| [0.2 + if (i + i / WIDTH).is_multiple_of(2) { amount } else { -amount }; 3])
                .collect()
        };
        let blurred = mean(&flip(WIDTH, &grey, &checker(0.1), PIXELS_PER_DEGREE));
        let shifted = mean(&flip(WIDTH, &grey, &plain([0.3; 3]), PIXELS_PER_DEGREE));
        assert!(blurred < 0.5 * shifted, "{blurred} and {shifted}");
        // Seen from nearer, the pattern is visible.
        let near = mean(&flip(WIDTH, &grey, &checker(0.1), 0.2 * PIXELS_PER_DEGREE));
        assert!(near > 2.0 * blurred, "{near} and {blurred}");
    }

    #[test]
    fn pictures_of_any_size_and_bad_numbers_are_no_errors() {
        assert!(flip(0, &[], &[], PIXELS_PER_DEGREE).is_empty());
        assert_eq!(flip(1, &[[f32::NAN; 3]], &[[0.0; 3]], f32::NAN), [0.0]);
        assert_eq!(flip(3, &[[1.0; 3]; 3], &[[2.0; 3]; 4], PIXELS_PER_DEGREE), [0.0; 3]);
    }
}
