//! Spectra in bands of 10 nm, and their colours.

use glam::DVec3;
use gonio_light::observer::{COLORIMETRY, LAMBDA_MIN, matching};
use std::sync::LazyLock;

/// Visible bands, from 380 to 780 nm.
pub const BANDS: usize = 40;
/// The width of a band, nm.
pub const BAND_WIDTH: f64 = 10.0;

/// The wavelength in the middle of a band, nm.
pub fn band_lambda(band: usize) -> f64 {
    LAMBDA_MIN + BAND_WIDTH * (band as f64 + 0.5)
}

/// A value for each band: spectral radiance, or a reflectance.
pub type BandSpectrum = [f64; BANDS];

/// The linear sRGB colour of radiance 1 per nm in each band, where daylight has (1, 1, 1).
static RESPONSE: LazyLock<[DVec3; BANDS]> = LazyLock::new(|| {
    std::array::from_fn(|band| {
        let center = band_lambda(band);
        // The mean over the band: the tables are linear between multiples of 5 nm.
        let mean = 0.25 * (matching(center - 5.0) + 2.0 * matching(center) + matching(center + 5.0));
        COLORIMETRY.rgb_from_xyz * mean * (BAND_WIDTH / COLORIMETRY.y_integral)
    })
});

/// The linear sRGB colour of spectral radiance; negative channels where it is beyond sRGB.
pub fn color_of_light(radiance: &BandSpectrum) -> DVec3 {
    RESPONSE.iter().zip(radiance).map(|(response, radiance)| *response * *radiance).sum()
}

/// A saturated colour brought into sRGB: mixed with the grey of its luminance until no channel is negative.
pub fn in_gamut(rgb: DVec3) -> DVec3 {
    let luminance = rgb.dot(DVec3::new(0.2126, 0.7152, 0.0722)).max(0.0);
    let least = rgb.min_element();
    let share = if least < 0.0 { luminance / (luminance - least) } else { 1.0 };
    DVec3::splat(luminance).lerp(rgb, share).max(DVec3::ZERO)
}

#[cfg(test)]
mod tests {
    use super::*;
    use gonio_light::observer::daylight;

    #[test]
    fn daylight_is_white() {
        let white = color_of_light(&std::array::from_fn(|band| daylight(band_lambda(band))));
        // The bands' rounding.
        assert!((white - 1.0).abs().max_element() < 2e-3, "{white}");
    }

    #[test]
    fn saturated_light_keeps_its_luminance() {
        let line: BandSpectrum = std::array::from_fn(|band| if band_lambda(band) == 525.0 { 1.0 } else { 0.0 });
        let (light, shown) = (color_of_light(&line), in_gamut(color_of_light(&line)));
        let luminance = |rgb: DVec3| rgb.dot(DVec3::new(0.2126, 0.7152, 0.0722));
        assert!(light.min_element() < 0.0 && shown.min_element() >= 0.0);
        assert!((luminance(light) - luminance(shown)).abs() < 1e-9);
    }
}
