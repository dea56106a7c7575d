//! Reradiation matrices: light that is absorbed in one band and emitted in another.

use crate::bands::{BAND_WIDTH, BANDS, BandSpectrum};
use gonio_light::observer::LAMBDA_MIN;

/// Bands of ultraviolet light before the visible ones, from 300 to 380 nm.
pub const ULTRAVIOLET_BANDS: usize = 8;
/// All bands, from 300 to 780 nm.
pub const ALL_BANDS: usize = ULTRAVIOLET_BANDS + BANDS;

/// The wavelength in the middle of a band of a matrix, nm.
pub fn lambda_of(band: usize) -> f64 {
    LAMBDA_MIN + BAND_WIDTH * (band as f64 + 0.5 - ULTRAVIOLET_BANDS as f64)
}

/// Radiance per nm in all bands.
pub type WideSpectrum = [f64; ALL_BANDS];

/// The visible bands.
pub fn visible(light: &WideSpectrum) -> BandSpectrum {
    std::array::from_fn(|band| light[ULTRAVIOLET_BANDS + band])
}

/// A bell of height 1, nm.
pub fn bell(lambda: f64, center: f64, width: f64) -> f64 {
    (-0.5 * ((lambda - center) / width).powi(2)).exp()
}

/// A dye.
#[derive(Clone, Copy, Debug)]
pub struct Dye {
    /// Bells of the share of light that is absorbed: height, middle in nm, width in nm.
    pub absorption: [[f64; 3]; 2],
    /// Middle and width of the emission, nm.
    pub emission: [f64; 2],
    /// Photons emitted for each photon absorbed, 0 to 1.
    pub quantum_yield: f64,
}

impl Dye {
    /// The share of light that is absorbed at full strength.
    pub fn absorbed(&self, lambda: f64) -> f64 {
        self.absorption
            .iter()
            .map(|[height, center, width]| height * bell(lambda, *center, *width))
            .sum::<f64>()
            .min(1.0)
    }

    /// The relative number of photons emitted at a wavelength; the tail towards longer ones is wider.
    fn emitted(&self, lambda: f64) -> f64 {
        let [center, width] = self.emission;
        bell(lambda, center, if lambda > center { 2.0 * width } else { width })
    }
}

/// What a surface makes of light: the entry `[to][from]` is the radiance in band `to` for radiance 1 in band `from`.
///
/// Source: R. Donaldson, *Spectrophotometry of fluorescent pigments*, British Journal of Applied Physics 5, 1954.
#[derive(Clone, Debug)]
pub struct ReradiationMatrix(Vec<WideSpectrum>);

impl ReradiationMatrix {
    /// A layer of dye on a surface. `strength`: the share of light that meets dye, 0 to 1. The dye absorbs photons, and emits
    /// `quantum_yield` times as many, each with no more energy than the absorbed one (G. G. Stokes 1852):
    ///
    /// ```text
    /// M_ij = yield a_j e_i lambda_j / lambda_i   (i > j, sum of e_i = 1)     M_jj = (1 - a_j) r_j     M_ij = 0  (i < j)
    /// ```
    pub fn new(surface: impl Fn(f64) -> f64, dye: &Dye, strength: f64) -> Self {
        let mut entries = vec![[0.0; ALL_BANDS]; ALL_BANDS];
        for from in 0..ALL_BANDS {
            let lambda = lambda_of(from);
            let absorbed = strength * dye.absorbed(lambda);
            entries[from][from] = (1.0 - absorbed) * surface(lambda);
            let photons = |to: usize| if to > from { dye.emitted(lambda_of(to)) } else { 0.0 };
            let all: f64 = (from + 1..ALL_BANDS).map(photons).sum();
            // At the last bands no emission is left: the absorbed light becomes heat.
            if all > 1e-9 {
                for (to, row) in entries.iter_mut().enumerate().skip(from + 1) {
                    row[from] = dye.quantum_yield * absorbed * photons(to) / all * lambda / lambda_of(to);
                }
            }
        }
        Self(entries)
    }

    /// An entry.
    pub fn at(&self, to: usize, from: usize) -> f64 {
        self.0[to][from]
    }

    /// The radiance that leaves the surface.
    pub fn apply(&self, light: &WideSpectrum) -> WideSpectrum {
        std::array::from_fn(|to| self.0[to].iter().zip(light).map(|(entry, light)| entry * light).sum())
    }

    /// The part of it that has another wavelength than before.
    pub fn fluorescence(&self, light: &WideSpectrum) -> WideSpectrum {
        std::array::from_fn(|to| self.0[to][..to].iter().zip(light).map(|(entry, light)| entry * light).sum())
    }
}

/// The photons of radiance in a band, relative to those of the same radiance at 1 nm.
pub fn photons(light: &WideSpectrum) -> f64 {
    light.iter().enumerate().map(|(band, light)| light * lambda_of(band)).sum()
}

#[cfg(test)]
mod tests {
    use super::super::inks;
    use super::*;

    /// Issue 21: the matrix applied by hand. One line of light at 365 nm, a dye that absorbs half of it and emits in two bands.
    #[test]
    fn the_matrix_is_that_of_the_formula() {
        let dye = Dye { absorption: [[0.5, 365.0, 4.0], [0.0, 1.0, 1.0]], emission: [520.0, 2.0], quantum_yield: 0.8 };
        let matrix = ReradiationMatrix::new(|_| 0.9, &dye, 1.0);
        let mut light = [0.0; ALL_BANDS];
        light[6] = 2.0;
        assert_eq!(lambda_of(6), 365.0);
        let out = matrix.apply(&light);
        // Bands at 515 and 525 nm: emission exp(-(5/2)^2/2) before the middle, with the wider bell behind it.
        let (before, behind) = ((-0.5 * 2.5_f64.powi(2)).exp(), (-0.5 * (5.0_f64 / 4.0).powi(2)).exp());
        let all: f64 = (7..ALL_BANDS).map(|to| dye.emitted(lambda_of(to))).sum();
        assert!((out[21] - 2.0 * 0.8 * 0.5 * before / all * 365.0 / 515.0).abs() < 1e-12);
        assert!((out[22] - 2.0 * 0.8 * 0.5 * behind / all * 365.0 / 525.0).abs() < 1e-12);
        assert!((out[6] - 2.0 * 0.5 * 0.9).abs() < 1e-12);
        assert!((photons(&matrix.fluorescence(&light)) - 0.8 * 0.5 * photons(&light)).abs() < 1e-9);
    }

    #[test]
    fn energy_moves_to_longer_wavelengths_only_and_none_is_made() {
        for ink in inks::ALL {
            let matrix = ink.matrix(1.0);
            for from in 0..ALL_BANDS {
                assert!((0..from).all(|to| matrix.at(to, from) == 0.0), "towards shorter wavelengths");
                let sum: f64 = (0..ALL_BANDS).map(|to| matrix.at(to, from)).sum();
                assert!((0.0..=1.0).contains(&sum), "{from}: {sum}");
            }
        }
    }
}
