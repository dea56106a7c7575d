//! What the four lanes of light along a path mean: RGB, or four wavelengths.

use crate::sampler::Sampler;
use crate::spectra::Spectra;
use crate::upsampling::Coefficients;
use crate::wavelengths::Wavelengths;
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

/// A constant colour, its spectrum looked up once.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tint {
    /// Linear RGB.
    rgb: Vec3,
    spectrum: Coefficients,
    /// The spectrum is multiplied by this.
    scale: f32,
    /// The index of the table that replaces `spectrum`, and daylight.
    table: Option<u32>,
}

impl Tint {
    /// A reflectance: channels are held in `[0, 1]`.
    pub fn of_reflectance(rgb: Vec3) -> Self {
        Tint { rgb, spectrum: Coefficients::of(rgb), scale: 1.0, table: None }
    }

    /// Linear RGB.
    pub fn rgb(&self) -> Vec3 {
        self.rgb
    }

    /// The same colour with a spectrum of its own, `scale` times the table: a reflectance.
    pub fn with_reflectance(self, table: u32, scale: f32) -> Self {
        Tint { table: Some(table), scale, ..self }
    }

    /// Light with a spectrum of its own, as bright as the colour.
    pub fn with_light(self, table: u32, luminance: f64) -> Self {
        let scale = gonio_light::color::luminance(self.rgb.as_dvec3()) / luminance;
        if scale.is_finite() { Tint { table: Some(table), scale: scale as f32, ..self } } else { self }
    }

    /// The colour of light, not negative.
    pub fn of_light(rgb: Vec3) -> Self {
        let scale = 2.0 * rgb.max_element();
        let is_light = scale > 0.0 && scale.is_finite();
        let spectrum = Coefficients::of(if is_light { rgb / scale } else { Vec3::ZERO });
        Tint { rgb, spectrum, scale: if is_light { scale } else { 0.0 }, table: None }
    }
}

impl ColorMode {
    /// The wavelengths of a path.
    pub(crate) fn wavelengths<'s>(self, sampler: &mut Sampler, spectra: &'s Spectra) -> Wavelengths<'s> {
        match self {
            ColorMode::Spectral => {
                let u = sampler.next_1d();
                let sampled =
                    spectra.choice.as_ref().map_or_else(|| Wavelengths::sample(u), |c| Wavelengths::choose(u, c));
                sampled.with_tables(&spectra.tables)
            }
            ColorMode::Rgb => Wavelengths::NONE,
        }
    }

    /// A reflectance in the lanes of a path.
    pub(crate) fn reflectance(self, tint: &Tint, wavelengths: &Wavelengths) -> Vec4 {
        match (self, tint.table) {
            (ColorMode::Rgb, _) => tint.rgb.extend(0.0),
            (ColorMode::Spectral, None) => tint.spectrum.at(wavelengths.lambda),
            (ColorMode::Spectral, Some(table)) => tint.scale * wavelengths.look_up(table),
        }
    }

    /// Light in the lanes of a path: the colour's spectrum times daylight, or its own spectrum.
    pub(crate) fn light(self, tint: &Tint, wavelengths: &Wavelengths) -> Vec4 {
        match (self, tint.table) {
            (ColorMode::Rgb, _) => tint.rgb.extend(0.0),
            (ColorMode::Spectral, None) => tint.scale * tint.spectrum.at(wavelengths.lambda) * wavelengths.daylight,
            (ColorMode::Spectral, Some(table)) => tint.scale * wavelengths.look_up(table),
        }
    }

    /// A BRDF's value per channel, which may exceed 1, at wavelengths in nm: white light that it scatters has that colour.
    pub(crate) fn unbounded(self, rgb: Vec3, lambda: Vec4) -> Vec4 {
        match self {
            ColorMode::Rgb => rgb.extend(0.0),
            // As light, with its largest channel at half of what a spectrum can be.
            ColorMode::Spectral => {
                let scale = 2.0 * rgb.max_element();
                if scale > 0.0 { scale * Coefficients::of(rgb / scale).at(lambda) } else { Vec4::ZERO }
            }
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
            ColorMode::Spectral => wavelengths.rgb(light),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectra::SpectrumTable;

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

    /// A line of 4 nm: its luminance is that of the colour, and no path is much brighter than the mean.
    #[test]
    fn narrow_light_has_the_right_mean_and_little_variance() {
        let mut spectra = Spectra::default();
        let line = SpectrumTable::new(|lambda| (2.0 - (lambda - 589.0).abs()).max(0.0));
        let luminance = line.luminance;
        let table = spectra.add(line);
        let spectra = spectra.finish(&[(table, 1.0)]);
        let tint = Tint::of_light(Vec3::new(2.0, 1.0, 0.1)).with_light(table, luminance);
        let count = 4096;
        let (mut sum, mut squares) = (0.0, 0.0);
        for i in 0..count {
            let mut sampler = Sampler::new(1, 0, i);
            let wavelengths = ColorMode::Spectral.wavelengths(&mut sampler, &spectra);
            let rgb = ColorMode::Spectral.rgb(ColorMode::Spectral.light(&tint, &wavelengths), &wavelengths);
            let y = gonio_light::color::luminance(rgb.as_dvec3());
            sum += y;
            squares += y * y;
        }
        let mean = sum / f64::from(count);
        let expected = gonio_light::color::luminance(glam::DVec3::new(2.0, 1.0, 0.1));
        assert!((mean / expected - 1.0).abs() < 0.01, "{mean} instead of {expected}");
        // Half of the wavelengths are chosen for the line, so paths miss it in one case of 16, and vary with its shape.
        let deviation = (squares / f64::from(count) - mean * mean).sqrt();
        assert!(deviation < 0.6 * mean, "{deviation} of {mean}");
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
