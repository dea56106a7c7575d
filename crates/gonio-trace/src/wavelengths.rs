//! The wavelengths of a path, and how the eye sees them.

use crate::sampling::Discrete;
use crate::spectra::{Spectra, SpectrumTable, choose};
use glam::{Vec3, Vec4};
use gonio_light::observer::{COLORIMETRY, LAMBDA_MAX, LAMBDA_MIN, SAMPLES, daylight, matching};
use std::sync::LazyLock;

/// Four wavelengths of one path. In RGB mode unused.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wavelengths<'s> {
    /// nm.
    pub lambda: Vec4,
    /// Daylight at the wavelengths, see [`daylight`].
    pub daylight: Vec4,
    /// The linear sRGB colour of radiance 1 at each wavelength, divided by the number of wavelengths and by its density.
    response: [Vec3; 4],
    tables: &'s [SpectrumTable],
}

/// Wavelengths are sampled with the density `sech^2(STEEPNESS (lambda - CENTER))`, which is close to what eyes see (M.
/// Radziszewski et al., *An Improved Technique for Full Spectral Rendering*, WSCG 2009).
const STEEPNESS: f64 = 0.0072;
const CENTER: f64 = 538.0;

/// The integral of the density up to a wavelength, up to a constant and a factor.
fn edge(lambda: f64) -> f64 {
    (STEEPNESS * (lambda - CENTER)).tanh()
}

/// The density of wavelengths without tables, 1/nm.
fn visible_density(lambda: f64) -> f64 {
    // sech^2 = 1 - tanh^2
    STEEPNESS * (1.0 - edge(lambda).powi(2)) / (edge(LAMBDA_MAX) - edge(LAMBDA_MIN))
}

/// Intervals of equal probability. Within each the density is taken as even.
const INTERVALS: usize = 1024;

/// The ends of the intervals, nm.
static ENDS: LazyLock<[f32; INTERVALS + 1]> = LazyLock::new(|| {
    let (low, high) = (edge(LAMBDA_MIN), edge(LAMBDA_MAX));
    std::array::from_fn(|i| {
        let lambda = CENTER + (low + (high - low) * i as f64 / INTERVALS as f64).atanh() / STEEPNESS;
        lambda.clamp(LAMBDA_MIN, LAMBDA_MAX) as f32
    })
});

/// Nm between the samples of [`SEEN`].
const STEP: f64 = (LAMBDA_MAX - LAMBDA_MIN) / (SAMPLES - 1) as f64;

/// The colour of radiance 1 and, last, daylight. Both are linear between these wavelengths.
static SEEN: LazyLock<[Vec4; SAMPLES]> = LazyLock::new(|| {
    std::array::from_fn(|i| {
        let lambda = LAMBDA_MIN + STEP * i as f64;
        let rgb = COLORIMETRY.rgb_from_xyz * (matching(lambda) / COLORIMETRY.y_integral);
        rgb.extend(daylight(lambda)).as_vec4()
    })
});

/// [`SEEN`] at a wavelength from the first to the last, nm.
#[inline]
fn seen(table: &[Vec4; SAMPLES], lambda: f32) -> Vec4 {
    let at = (lambda - LAMBDA_MIN as f32) * (1.0 / STEP) as f32;
    let i = (at as usize).min(SAMPLES - 2);
    table[i] + (table[i + 1] - table[i]) * (at - i as f32)
}

impl Spectra {
    /// [`Spectra::choose_for`] these lights: tables and weights.
    pub(crate) fn finish(mut self, lights: &[(u32, f64)]) -> Self {
        self.choose_for(lights, visible_density);
        self
    }
}

impl<'s> Wavelengths<'s> {
    /// What RGB mode has instead.
    pub const NONE: Wavelengths<'static> =
        Wavelengths { lambda: Vec4::ZERO, daylight: Vec4::ZERO, response: [Vec3::ZERO; 4], tables: &[] };

    /// Sets a wavelength, nm, with the reciprocal of its density, nm.
    #[inline]
    fn set(&mut self, table: &[Vec4; SAMPLES], i: usize, lambda: f32, width: f32) {
        let seen = seen(table, lambda);
        self.lambda[i] = lambda;
        self.daylight[i] = seen.w;
        self.response[i] = seen.truncate() * (0.25 * width);
    }

    /// [`Self::sample`] where some light has a spectrum of its own.
    pub fn choose(u: f32, choice: &Discrete) -> Self {
        let mut sampled = Wavelengths::NONE;
        for i in 0..4 {
            let Some((lambda, density)) = choose(choice, (u + 0.25 * i as f32).fract()) else { continue };
            sampled.set(&SEEN, i, lambda as f32, (1.0 / density) as f32);
        }
        sampled
    }

    /// Four wavelengths, at `u` in `[0, 1)` and a quarter apart from each other in the distribution.
    pub fn sample(u: f32) -> Self {
        let (ends, table) = (&*ENDS, &*SEEN);
        let mut sampled = Wavelengths::NONE;
        for i in 0..4 {
            let at = (u + 0.25 * i as f32).fract() * INTERVALS as f32;
            let interval = (at as usize).min(INTERVALS - 1);
            let width = ends[interval + 1] - ends[interval];
            let lambda = ends[interval] + width * (at - interval as f32);
            sampled.set(table, i, lambda, width * INTERVALS as f32);
        }
        sampled
    }

    /// The same wavelengths, with spectra of the scene.
    pub fn with_tables(self, tables: &[SpectrumTable]) -> Wavelengths<'_> {
        Wavelengths { tables, lambda: self.lambda, daylight: self.daylight, response: self.response }
    }

    /// A spectrum of the scene at the wavelengths.
    #[inline]
    pub fn look_up(&self, table: u32) -> Vec4 {
        self.tables[table as usize].at(self.lambda)
    }

    /// Keeps the first wavelength only: the path now depends on it (dispersion).
    pub fn keep_first(&mut self) {
        if self.response[1..].iter().any(|&response| response != Vec3::ZERO) {
            self.response = [4.0 * self.response[0], Vec3::ZERO, Vec3::ZERO, Vec3::ZERO];
        }
    }

    /// The estimate of the linear sRGB colour of light at the wavelengths.
    #[inline]
    pub fn rgb(&self, light: Vec4) -> Vec3 {
        let mut rgb = Vec3::ZERO;
        for (response, light) in self.response.into_iter().zip(light.to_array()) {
            // Light of wavelengths that do not count may be infinite.
            if response != Vec3::ZERO {
                rgb += response * light;
            }
        }
        rgb
    }
}
