//! Spectra of lamps and surfaces, and the colours that they have.

use crate::DVec3;
use crate::observer::{COLORIMETRY, LAMBDA_MAX, LAMBDA_MIN, SAMPLES, daylight, matching};

/// A function of the wavelength that is linear between its samples.
#[derive(Clone, Debug, PartialEq)]
pub struct Spectrum(Vec<[f64; 2]>);

impl Spectrum {
    /// The spectrum with these samples: wavelength in nm, rising, and value, >= 0.
    pub fn new(samples: Vec<[f64; 2]>) -> Self {
        Spectrum(samples)
    }

    /// Its samples.
    pub fn samples(&self) -> &[[f64; 2]] {
        &self.0
    }

    /// The power of a light at wavelength `lambda`, nm, in no unit; 0 beyond the samples.
    pub fn power_at(&self, lambda: f64) -> f64 {
        let covers = |first: &[f64; 2], last: &[f64; 2]| (first[0]..=last[0]).contains(&lambda);
        match (self.0.first(), self.0.last()) {
            (Some(first), Some(last)) if covers(first, last) => self.reflectance_at(lambda),
            _ => 0.0,
        }
    }

    /// The reflectance of a surface at wavelength `lambda`, nm; beyond the samples that of the nearest.
    pub fn reflectance_at(&self, lambda: f64) -> f64 {
        let next = self.0.partition_point(|sample| sample[0] <= lambda);
        match (next.checked_sub(1).and_then(|i| self.0.get(i)), self.0.get(next)) {
            (Some([from, a]), Some([to, b])) => a + (b - a) * (lambda - from) / (to - from),
            (Some([_, only]), None) | (None, Some([_, only])) => *only,
            (None, None) => 0.0,
        }
    }

    /// The luminance of a light with this radiance per nm, where daylight ([`daylight`]) has 1.
    pub fn luminance(&self) -> f64 {
        self.integral(|lambda| self.power_at(lambda) * matching(lambda)).y
    }

    /// The colour of a light with this spectrum, linear sRGB, at luminance 1; `None` where it is invisible.
    ///
    /// A colour outside of sRGB is mixed with white until its smallest channel is 0: its hue stays nearly, its saturation
    /// decreases.
    pub fn color_of_light(&self) -> Option<DVec3> {
        let xyz = self.integral(|lambda| self.power_at(lambda) * matching(lambda));
        (xyz.y > 1e-9).then(|| in_gamut(COLORIMETRY.rgb_from_xyz * (xyz / xyz.y), 1.0))
    }

    /// The colour of a surface with this reflectance in daylight (D65), linear sRGB, each channel in [0, 1].
    ///
    /// A colour outside of sRGB is mixed with the grey of its luminance until no channel is negative.
    pub fn color_of_surface(&self) -> DVec3 {
        let xyz = self.integral(|lambda| self.reflectance_at(lambda) * daylight(lambda) * matching(lambda));
        in_gamut(COLORIMETRY.rgb_from_xyz * xyz, xyz.y).min(DVec3::ONE)
    }

    /// The integral of a product of this spectrum and the tables, divided by that of the second matching function.
    ///
    /// Between the samples of all factors the product is a cubic polynomial at most, for which Simpson's rule is exact.
    fn integral(&self, product: impl Fn(f64) -> DVec3) -> DVec3 {
        let step = (LAMBDA_MAX - LAMBDA_MIN) / (SAMPLES - 1) as f64;
        let mut bounds: Vec<f64> = (0..SAMPLES).map(|i| LAMBDA_MIN + step * i as f64).collect();
        bounds.extend(self.0.iter().map(|sample| sample[0]).filter(|l| (LAMBDA_MIN..=LAMBDA_MAX).contains(l)));
        bounds.sort_by(f64::total_cmp);
        let simpson = |pair: &[f64]| {
            // A light ends at once at its last sample: the ends are evaluated just inside.
            let [from, to] = [pair[0].next_up(), pair[1].next_down()];
            (product(from) + 4.0 * product(0.5 * (from + to)) + product(to)) * ((pair[1] - pair[0]) / 6.0)
        };
        bounds.windows(2).filter(|pair| pair[0] < pair[1]).map(simpson).sum::<DVec3>() / COLORIMETRY.y_integral
    }
}

/// `rgb` mixed with the grey of its `luminance` until no channel is negative.
fn in_gamut(rgb: DVec3, luminance: f64) -> DVec3 {
    let least = rgb.min_element();
    let share = if least < 0.0 { luminance / (luminance - least) } else { 1.0 };
    DVec3::splat(luminance).lerp(rgb, share).max(DVec3::ZERO)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::color::luminance;

    #[test]
    fn a_spectrum_is_linear_between_its_samples() {
        let s = Spectrum::new(vec![[400.0, 0.0], [500.0, 1.0], [600.0, 0.5]]);
        assert_eq!([450.0, 500.0, 550.0].map(|l| s.power_at(l)), [0.5, 1.0, 0.75]);
        assert_eq!([399.0, 400.0, 600.0, 601.0].map(|l| s.power_at(l)), [0.0, 0.0, 0.5, 0.0]);
        assert_eq!([300.0, 450.0, 700.0].map(|l| s.reflectance_at(l)), [0.0, 0.5, 0.5]);
    }

    /// A surface that reflects all light equally is grey, and a light like daylight is white.
    #[test]
    fn grey_and_daylight_have_no_hue() {
        let grey = Spectrum::new(vec![[400.0, 0.3]]).color_of_surface();
        // The white is a sum at the tables' wavelengths: it differs from the exact integral in the fourth digit.
        assert!((grey - 0.3).abs().max_element() < 2e-4, "{grey}");
        let day = Spectrum::new((380..=780).step_by(10).map(|l| [f64::from(l), daylight(f64::from(l))]).collect());
        assert!((day.color_of_light().unwrap() - 1.0).abs().max_element() < 1e-3);
        assert!((day.luminance() - 1.0).abs() < 1e-3, "{}", day.luminance());
    }

    /// Spectral colours are outside of sRGB: they lose saturation and keep their luminance, however narrow the line is.
    #[test]
    fn a_narrow_line_is_a_saturated_colour_of_luminance_1() {
        for (line, strongest) in [(450.0, 2), (530.0, 1), (589.3, 0), (630.0, 0)] {
            for width in [0.01, 5.0] {
                let s = Spectrum::new(vec![[line - width, 0.0], [line, 7.0], [line + width, 0.0]]);
                let rgb = s.color_of_light().unwrap();
                assert_eq!(rgb.max_position(), strongest, "{line}: {rgb}");
                assert!(rgb.min_element().abs() < 1e-12, "{line}: {rgb}");
                assert!((luminance(rgb) - 1.0).abs() < 1e-3, "{line}: {rgb}");
            }
        }
        assert_eq!(Spectrum::new(vec![[800.0, 1.0], [900.0, 1.0]]).color_of_light(), None);
    }
}
