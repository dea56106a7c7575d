//! The CIE 1931 standard observer (2 degrees), daylight D65, and linear sRGB.
//!
//! *Sources*: CIE 15:2004, *Colorimetry*, tables T.1 (illuminant D65, here every 10 nm, between which CIE interpolates linearly)
//! and T.4 (colour matching functions, every 5 nm). IEC 61966-2-1:1999 for the primaries of sRGB.

use crate::{DMat3, DVec3};
use std::sync::LazyLock;

/// The shortest wavelength of the tables, nm.
pub const LAMBDA_MIN: f64 = 380.0;
/// The longest, nm.
pub const LAMBDA_MAX: f64 = 780.0;
/// Wavelengths of `MATCHING`.
pub const SAMPLES: usize = 81;

/// The colour matching functions at wavelength `lambda` (nm), linear between the table's values; 0 beyond them.
pub fn matching(lambda: f64) -> DVec3 {
    let at = (lambda - LAMBDA_MIN) / 5.0;
    if !(0.0..=(SAMPLES - 1) as f64).contains(&at) {
        return DVec3::ZERO;
    }
    let i = (at as usize).min(SAMPLES - 2);
    DVec3::from(MATCHING[i]).lerp(DVec3::from(MATCHING[i + 1]), at - i as f64)
}

/// D65 relative to its mean luminance: a light of this radiance per nm has Y = 1. 0 beyond the tables.
pub fn daylight(lambda: f64) -> f64 {
    relative_daylight(lambda) * COLORIMETRY.daylight_scale
}

fn relative_daylight(lambda: f64) -> f64 {
    let at = (lambda - LAMBDA_MIN) / 10.0;
    if !(0.0..=(DAYLIGHT.len() - 1) as f64).contains(&at) {
        return 0.0;
    }
    let i = (at as usize).min(DAYLIGHT.len() - 2);
    DAYLIGHT[i] + (DAYLIGHT[i + 1] - DAYLIGHT[i]) * (at - i as f64)
}

/// Everything that follows from the tables.
pub struct Colorimetry {
    /// The integral of the second colour matching function, nm.
    pub y_integral: f64,
    /// The factor of the table of daylight.
    daylight_scale: f64,
    /// Linear sRGB from XYZ, with the white of [`daylight`] at (1, 1, 1).
    pub rgb_from_xyz: DMat3,
}

/// Computed once.
pub static COLORIMETRY: LazyLock<Colorimetry> = LazyLock::new(|| {
    let lambdas = || (0..SAMPLES).map(|i| LAMBDA_MIN + 5.0 * i as f64);
    let y_integral: f64 = 5.0 * lambdas().map(|l| matching(l).y).sum::<f64>();
    let white: DVec3 = lambdas().map(|l| matching(l) * relative_daylight(l)).sum::<DVec3>() * (5.0 / y_integral);
    let daylight_scale = 1.0 / white.y;
    let white = white * daylight_scale;
    let primary = |x: f64, y: f64| DVec3::new(x / y, 1.0, (1.0 - x - y) / y);
    let primaries = DMat3::from_cols(primary(0.64, 0.33), primary(0.30, 0.60), primary(0.15, 0.06));
    let shares = primaries.inverse() * white;
    let xyz_from_rgb = primaries * DMat3::from_diagonal(shares);
    Colorimetry { y_integral, daylight_scale, rgb_from_xyz: xyz_from_rgb.inverse() }
});

/// Colour matching functions from 380 to 780 nm every 5 nm.
#[rustfmt::skip]
const MATCHING: [[f64; 3]; SAMPLES] = [
    [0.001368, 0.000039, 0.006450], [0.002236, 0.000064, 0.010550], [0.004243, 0.000120, 0.020050],
    [0.007650, 0.000217, 0.036210], [0.014310, 0.000396, 0.067850], [0.023190, 0.000640, 0.110200],
    [0.043510, 0.001210, 0.207400], [0.077630, 0.002180, 0.371300], [0.134380, 0.004000, 0.645600],
    [0.214770, 0.007300, 1.039050], [0.283900, 0.011600, 1.385600], [0.328500, 0.016840, 1.622960],
    [0.348280, 0.023000, 1.747060], [0.348060, 0.029800, 1.782600], [0.336200, 0.038000, 1.772110],
    [0.318700, 0.048000, 1.744100], [0.290800, 0.060000, 1.669200], [0.251100, 0.073900, 1.528100],
    [0.195360, 0.090980, 1.287640], [0.142100, 0.112600, 1.041900], [0.095640, 0.139020, 0.812950],
    [0.057950, 0.169300, 0.616200], [0.032010, 0.208020, 0.465180], [0.014700, 0.258600, 0.353300],
    [0.004900, 0.323000, 0.272000], [0.002400, 0.407300, 0.212300], [0.009300, 0.503000, 0.158200],
    [0.029100, 0.608200, 0.111700], [0.063270, 0.710000, 0.078250], [0.109600, 0.793200, 0.057250],
    [0.165500, 0.862000, 0.042160], [0.225750, 0.914850, 0.029840], [0.290400, 0.954000, 0.020300],
    [0.359700, 0.980300, 0.013400], [0.433450, 0.994950, 0.008750], [0.512050, 1.000000, 0.005750],
    [0.594500, 0.995000, 0.003900], [0.678400, 0.978600, 0.002750], [0.762100, 0.952000, 0.002100],
    [0.842500, 0.915400, 0.001800], [0.916300, 0.870000, 0.001650], [0.978600, 0.816300, 0.001400],
    [1.026300, 0.757000, 0.001100], [1.056700, 0.694900, 0.001000], [1.062200, 0.631000, 0.000800],
    [1.045600, 0.566800, 0.000600], [1.002600, 0.503000, 0.000340], [0.938400, 0.441200, 0.000240],
    [0.854450, 0.381000, 0.000190], [0.751400, 0.321000, 0.000100], [0.642400, 0.265000, 0.000050],
    [0.541900, 0.217000, 0.000030], [0.447900, 0.175000, 0.000020], [0.360800, 0.138200, 0.000010],
    [0.283500, 0.107000, 0.000000], [0.218700, 0.081600, 0.000000], [0.164900, 0.061000, 0.000000],
    [0.121200, 0.044580, 0.000000], [0.087400, 0.032000, 0.000000], [0.063600, 0.023200, 0.000000],
    [0.046770, 0.017000, 0.000000], [0.032900, 0.011920, 0.000000], [0.022700, 0.008210, 0.000000],
    [0.015840, 0.005723, 0.000000], [0.011359, 0.004102, 0.000000], [0.008111, 0.002929, 0.000000],
    [0.005790, 0.002091, 0.000000], [0.004109, 0.001484, 0.000000], [0.002899, 0.001047, 0.000000],
    [0.002049, 0.000740, 0.000000], [0.001440, 0.000520, 0.000000], [0.001000, 0.000361, 0.000000],
    [0.000690, 0.000249, 0.000000], [0.000476, 0.000172, 0.000000], [0.000332, 0.000120, 0.000000],
    [0.000235, 0.000085, 0.000000], [0.000166, 0.000060, 0.000000], [0.000117, 0.000042, 0.000000],
    [0.000083, 0.000030, 0.000000], [0.000059, 0.000021, 0.000000], [0.000042, 0.000015, 0.000000],
];

/// D65 from 380 to 780 nm every 10 nm, 100 at 560 nm.
#[rustfmt::skip]
const DAYLIGHT: [f64; 41] = [
    49.9755, 54.6482, 82.7549, 91.4860, 93.4318, 86.6823, 104.865, 117.008, 117.812, 114.861,
    115.923, 108.811, 109.354, 107.802, 104.790, 107.689, 104.405, 104.046, 100.000, 96.3342,
    95.7880, 88.6856, 90.0062, 89.5991, 87.6987, 83.2886, 83.6992, 80.0268, 80.2146, 82.2778,
    78.2842, 69.7213, 71.6091, 74.3490, 61.6040, 69.8856, 75.0870, 63.5927, 46.4182, 66.8054,
    63.3828,
];

#[cfg(test)]
mod tests {
    use super::*;

    /// The sums that CIE 15 states under table T.4.
    #[test]
    fn the_matching_functions_have_equal_integrals() {
        let sum: DVec3 = MATCHING.iter().map(|&m| DVec3::from(m)).sum();
        // The table's own rounding.
        assert!((sum - DVec3::new(21.3714, 21.3711, 21.3715)).abs().max_element() < 1e-3, "{sum}");
    }

    /// Chromaticity of D65 by CIE 15, and the matrix of IEC 61966-2-1.
    #[test]
    fn white_and_primaries_are_those_of_srgb() {
        let white = COLORIMETRY.rgb_from_xyz.inverse() * DVec3::ONE;
        let sum = white.element_sum();
        assert!((white.x / sum - 0.31272).abs() < 1e-4 && (white.y / sum - 0.32903).abs() < 1e-4, "{white}");
        let m = COLORIMETRY.rgb_from_xyz;
        let published = DMat3::from_cols(
            DVec3::new(3.2406, -0.9689, 0.0557),
            DVec3::new(-1.5372, 1.8758, -0.2040),
            DVec3::new(-0.4986, 0.0415, 1.0570),
        );
        // Four digits are published, with a white of four digits.
        assert!((0..3).all(|c| (m.col(c) - published.col(c)).abs().max_element() < 2e-3), "{m}");
    }
}
