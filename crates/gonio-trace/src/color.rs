//! What the four lanes of light along a path mean: RGB, or four wavelengths.

use crate::observer::{COLORIMETRY, LAMBDA_MAX, LAMBDA_MIN, daylight, matching};
use crate::upsampling::Coefficients;
use glam::{Vec3, Vec4};
use gonio_light::{Simplification, Simplifications};

/// How light is carried along a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ColorMode {
    /// Four wavelengths per path, by hero-wavelength sampling (A. Wilkie et al., *Hero Wavelength Spectral Sampling*, EGSR
    /// 2014).
    Spectral,
    /// Red, green and blue, as in OpenGL: faster, and wrong where colours multiply several times.
    Rgb,
}

impl ColorMode {
    /// The mode of a set of simplifications.
    pub fn of(simplified: Simplifications) -> Self {
        if simplified.contains(Simplification::Wavelengths) { ColorMode::Rgb } else { ColorMode::Spectral }
    }
}

/// The wavelengths of one path, nm, and the reciprocals of their densities divided by their number. In RGB mode unused.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wavelengths {
    pub lambda: Vec4,
    weight: Vec4,
    daylight: Vec4,
}

/// A constant colour, its spectrum looked up once.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tint {
    /// Linear RGB.
    rgb: Vec3,
    spectrum: Coefficients,
    /// The spectrum is multiplied by this.
    scale: f32,
}

impl Tint {
    /// A reflectance: channels are held in `[0, 1]`.
    pub fn of_reflectance(rgb: Vec3) -> Self {
        Tint { rgb, spectrum: Coefficients::of(rgb), scale: 1.0 }
    }

    /// The colour of light, not negative.
    pub fn of_light(rgb: Vec3) -> Self {
        let scale = 2.0 * rgb.max_element();
        let is_light = scale > 0.0 && scale.is_finite();
        let spectrum = Coefficients::of(if is_light { rgb / scale } else { Vec3::ZERO });
        Tint { rgb, spectrum, scale: if is_light { scale } else { 0.0 } }
    }
}

/// Wavelengths are sampled with the density `sech^2(STEEPNESS (lambda - CENTER))`, which is close to what eyes see (M.
/// Radziszewski et al., *An Improved Technique for Full Spectral Rendering*, WSCG 2009).
const STEEPNESS: f64 = 0.0072;
const CENTER: f64 = 538.0;

impl Wavelengths {
    /// What RGB mode has instead.
    pub const NONE: Wavelengths = Wavelengths { lambda: Vec4::ZERO, weight: Vec4::ZERO, daylight: Vec4::ZERO };

    /// Four wavelengths, at `u` in `[0, 1)` and a quarter apart from each other in the distribution.
    pub fn sample(u: f32) -> Self {
        let edge = |lambda: f64| (STEEPNESS * (lambda - CENTER)).tanh();
        let (low, high) = (edge(LAMBDA_MIN), edge(LAMBDA_MAX));
        let mut sampled = Wavelengths::NONE;
        for i in 0..4 {
            let t = low + (high - low) * (f64::from(u) + 0.25 * i as f64).fract();
            let lambda = CENTER + t.atanh() / STEEPNESS;
            // sech^2 = 1 - tanh^2
            let density = STEEPNESS * (1.0 - t * t) / (high - low);
            sampled.lambda[i] = lambda as f32;
            sampled.weight[i] = (0.25 / density) as f32;
            sampled.daylight[i] = daylight(lambda) as f32;
        }
        sampled
    }

    /// Keeps the first wavelength only: the path now depends on it (dispersion).
    pub fn keep_first(&mut self) {
        if self.weight.y != 0.0 {
            self.weight = Vec4::new(4.0 * self.weight.x, 0.0, 0.0, 0.0);
        }
    }
}

impl ColorMode {
    /// A reflectance in the lanes of a path.
    pub(crate) fn reflectance(self, tint: &Tint, wavelengths: &Wavelengths) -> Vec4 {
        match self {
            ColorMode::Rgb => tint.rgb.extend(0.0),
            ColorMode::Spectral => tint.spectrum.at(wavelengths.lambda),
        }
    }

    /// Light in the lanes of a path: the colour's spectrum times daylight.
    pub(crate) fn light(self, tint: &Tint, wavelengths: &Wavelengths) -> Vec4 {
        match self {
            ColorMode::Rgb => tint.rgb.extend(0.0),
            ColorMode::Spectral => tint.scale * tint.spectrum.at(wavelengths.lambda) * wavelengths.daylight,
        }
    }

    /// A value per channel that is no reflectance and may exceed 1 (absorption): smooth between the channels' dominant
    /// wavelengths (465, 550 and 612 nm), constant beyond them.
    pub(crate) fn coefficient(self, rgb: Vec3, wavelengths: &Wavelengths) -> Vec4 {
        match self {
            ColorMode::Rgb => rgb.extend(0.0),
            ColorMode::Spectral => Vec4::from(wavelengths.lambda.to_array().map(|l| {
                if l < 550.0 {
                    rgb.z + (rgb.y - rgb.z) * ((l - 465.0) / 85.0).clamp(0.0, 1.0)
                } else {
                    rgb.y + (rgb.x - rgb.y) * ((l - 550.0) / 62.0).clamp(0.0, 1.0)
                }
            })),
        }
    }

    /// The estimate of a linear sRGB colour that light along a path makes.
    pub(crate) fn rgb(self, light: Vec4, wavelengths: &Wavelengths) -> Vec3 {
        match self {
            ColorMode::Rgb => light.truncate(),
            ColorMode::Spectral => {
                let weighted = light * wavelengths.weight;
                let mut xyz = glam::DVec3::ZERO;
                for i in 0..4 {
                    if weighted[i] != 0.0 {
                        xyz += matching(wavelengths.lambda[i].into()) * f64::from(weighted[i]);
                    }
                }
                (COLORIMETRY.rgb_from_xyz * (xyz / COLORIMETRY.y_integral)).as_vec3()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The mean of many paths that carry a colour unchanged is the colour.
    #[test]
    fn light_keeps_its_color() {
        for rgb in [Vec3::ONE, Vec3::new(3.0, 0.5, 0.1), Vec3::new(0.0, 1.0, 0.3), Vec3::new(0.02, 0.05, 7.0)] {
            let count = 4096;
            let mean: Vec3 = (0..count)
                .map(|i| {
                    let wavelengths = Wavelengths::sample((i as f32 + 0.5) / count as f32);
                    ColorMode::Spectral.rgb(ColorMode::Spectral.light(&Tint::of_light(rgb), &wavelengths), &wavelengths)
                })
                .sum::<Vec3>()
                / count as f32;
            // The table of spectra is good to 1/100 of the largest channel.
            assert!((mean - rgb).abs().max_element() < 0.01 * rgb.max_element(), "{rgb}: {mean}");
        }
    }

    #[test]
    fn the_first_wavelength_alone_has_the_same_mean() {
        let count = 8192;
        let mean: Vec3 = (0..count)
            .map(|i| {
                let mut wavelengths = Wavelengths::sample((i as f32 + 0.5) / count as f32);
                wavelengths.keep_first();
                wavelengths.keep_first();
                ColorMode::Spectral
                    .rgb(ColorMode::Spectral.light(&Tint::of_light(Vec3::ONE), &wavelengths), &wavelengths)
            })
            .sum::<Vec3>()
            / count as f32;
        // The midpoint rule over a smooth function, and the tables' kinks.
        assert!((mean - 1.0).abs().max_element() < 1e-3, "{mean}");
    }
}
