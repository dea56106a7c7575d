//! Tabulated spectra of lights and materials, and the choice of wavelengths where lamps have lines.

use crate::sampling::Discrete;
use glam::Vec4;
use gonio_light::observer::{COLORIMETRY, LAMBDA_MAX, LAMBDA_MIN, matching};

/// Intervals of a table per nm: lines of discharge lamps are about so narrow.
const PER_NM: f64 = 8.0;
const INTERVALS: usize = ((LAMBDA_MAX - LAMBDA_MIN) * PER_NM) as usize;

/// The wavelength at a place of the table, nm.
fn lambda_at(place: f64) -> f64 {
    LAMBDA_MIN + place / PER_NM
}

/// A spectrum, linear between the points of a table.
#[derive(Clone, Debug)]
pub(crate) struct SpectrumTable {
    values: Vec<f32>,
    /// Its luminance as light, where daylight of colour 1 has 1.
    pub luminance: f64,
}

impl SpectrumTable {
    /// `spectrum`: of the wavelength, nm. Values that are negative or not finite count as 0.
    pub fn new(spectrum: impl Fn(f64) -> f64) -> Self {
        let at = |i: usize| {
            let value = spectrum(lambda_at(i as f64));
            if value.is_finite() { value.max(0.0) } else { 0.0 }
        };
        let values: Vec<f64> = (0..=INTERVALS).map(at).collect();
        let sum: f64 = values.iter().enumerate().map(|(i, v)| v * matching(lambda_at(i as f64)).y).sum();
        let luminance = sum / PER_NM / COLORIMETRY.y_integral;
        SpectrumTable { values: values.into_iter().map(|v| v as f32).collect(), luminance }
    }

    /// The spectrum at four wavelengths, nm.
    pub fn at(&self, lambda: Vec4) -> Vec4 {
        lambda.map(|lambda| {
            let x = ((lambda - LAMBDA_MIN as f32) * PER_NM as f32).clamp(0.0, INTERVALS as f32);
            let i = (x as usize).min(INTERVALS - 1);
            let (low, high) = (self.values[i], self.values[i + 1]);
            low + (high - low) * (x - i as f32)
        })
    }
}

/// The tables of a frame, and how wavelengths are chosen for them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Spectra {
    pub tables: Vec<SpectrumTable>,
    /// Where a light has a spectrum of its own: over the intervals.
    pub choice: Option<Discrete>,
}

impl Spectra {
    /// Adds a spectrum; returns its index.
    pub fn add(&mut self, table: SpectrumTable) -> u32 {
        self.tables.push(table);
        (self.tables.len() - 1) as u32
    }

    /// Chooses wavelengths half as `visible` (a density of the wavelength) does, and half where these lights, with their
    /// weights, are seen bright. None where there are no such lights.
    pub fn choose_for(&mut self, lights: &[(u32, f64)], visible: impl Fn(f64) -> f64) {
        if lights.is_empty() {
            return;
        }
        let mut power = vec![0.0; INTERVALS];
        for &(table, weight) in lights {
            let values = &self.tables[table as usize].values;
            for (i, power) in power.iter_mut().enumerate() {
                let seen = matching(lambda_at(i as f64 + 0.5)).element_sum();
                *power += weight * f64::from(0.5 * (values[i] + values[i + 1])) * seen;
            }
        }
        let total: f64 = power.iter().sum();
        let visible: Vec<f64> = (0..INTERVALS).map(|i| visible(lambda_at(i as f64 + 0.5))).collect();
        let visible_total: f64 = visible.iter().sum();
        let share = |sum: f64| if sum > 0.0 && sum.is_finite() { 0.5 / sum } else { 0.0 };
        let mixed = power.iter().zip(&visible).map(|(p, v)| p * share(total) + v * share(visible_total));
        self.choice = Some(Discrete::new(mixed));
    }
}

/// A wavelength, nm, at `u` in `[0, 1)`, with its density, 1/nm.
pub(crate) fn choose(choice: &Discrete, u: f32) -> Option<(f64, f64)> {
    let (interval, probability, rest) = choice.sample(u)?;
    Some((lambda_at(interval as f64 + f64::from(rest)), f64::from(probability) * PER_NM))
}
