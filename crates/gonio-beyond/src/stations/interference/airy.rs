//! Thin films and gratings.

use crate::bands::{BandSpectrum, band_lambda, color_of_light};
use crate::complex::{BoundaryAmplitudes, Complex, boundary_amplitudes};
use glam::DVec3;
use gonio_light::observer::daylight;
use std::f64::consts::{PI, TAU};

/// A film in air, on air or on another transparent medium.
#[derive(Clone, Copy, Debug)]
pub struct ThinFilm {
    /// The index of the film.
    pub index: f64,
    /// The index of the medium below; 1 for air.
    pub index_below: f64,
    /// nm.
    pub thickness_nm: f64,
}

/// The boundaries of a film for one angle of incidence.
pub struct FilmBoundaries {
    upper: BoundaryAmplitudes,
    lower: BoundaryAmplitudes,
    /// `2 n d cos t`, nm.
    path_nm: f64,
}

impl ThinFilm {
    /// For the cosine of the angle of incidence in air, above 0.
    pub fn boundaries(&self, cos_i: f64) -> FilmBoundaries {
        let [air, film, below] = [1.0, self.index, self.index_below].map(Complex::real);
        let upper = boundary_amplitudes(air, Complex::real(cos_i.clamp(1e-3, 1.0)), film);
        let lower = boundary_amplitudes(film, upper.cos_t, below);
        FilmBoundaries { upper, lower, path_nm: 2.0 * self.index * self.thickness_nm * upper.cos_t.re }
    }

    /// The linear sRGB colour of white light (daylight) that the film reflects.
    pub fn color(&self, cos_i: f64) -> DVec3 {
        let boundaries = self.boundaries(cos_i);
        let reflected: BandSpectrum = std::array::from_fn(|band| {
            let lambda = band_lambda(band);
            daylight(lambda) * boundaries.reflectance(lambda)
        });
        color_of_light(&reflected)
    }
}

impl FilmBoundaries {
    /// The share of unpolarised light that is reflected at a wavelength, by Airy's sum of all reflections between the
    /// boundaries:
    ///
    /// ```text
    /// r = (r_1 + r_2 e^(i phi)) / (1 + r_1 r_2 e^(i phi))     phi = 2 pi 2 n d cos t / lambda
    /// ```
    ///
    /// Source: G. B. Airy 1833; M. Born and E. Wolf, *Principles of Optics*, section 7.6.1.
    pub fn reflectance(&self, lambda: f64) -> f64 {
        let cos = (TAU * self.path_nm / lambda).cos();
        // Without absorption and total reflection both amplitudes are real.
        let of = |r1: f64, r2: f64| {
            let (product, both) = (r1 * r2, 2.0 * r1 * r2 * cos);
            (r1 * r1 + r2 * r2 + both) / (1.0 + product * product + both)
        };
        let [upper, lower] = [self.upper.reflected, self.lower.reflected];
        0.5 * (of(upper[0].re, lower[0].re) + of(upper[1].re, lower[1].re))
    }

    /// The same by adding `count` waves one after the other, each reflected once more between the boundaries.
    pub fn sum_of_waves(&self, lambda: f64, count: u32) -> f64 {
        let turn = Complex::phase(TAU * self.path_nm / lambda);
        let polarisation = |index: usize| {
            let (r1, r2) = (self.upper.reflected[index], self.lower.reflected[index]);
            // In and out again: Stokes's relation, t t' = 1 - r^2.
            let through = Complex::real(1.0) - r1 * r1;
            let mut sum = r1;
            let mut wave = through * r2 * turn;
            for _ in 0..count {
                sum = sum + wave;
                wave = wave * (-r1) * r2 * turn;
            }
            sum.square()
        };
        0.5 * (polarisation(0) + polarisation(1))
    }
}

/// The sine of the angle at which order `order` of a grating leaves, if there is one; `sin_i`: light at that angle on the other
/// side of the normal has order 0 there.
///
/// Source: J. Fraunhofer 1821; M. Born and E. Wolf, *Principles of Optics*, section 8.6.1, (5).
pub fn order_sine(sin_i: f64, order: i32, lambda_nm: f64, pitch_nm: f64) -> Option<f64> {
    let sine = sin_i + f64::from(order) * lambda_nm / pitch_nm;
    (sine.abs() <= 1.0).then_some(sine)
}

/// Grooves of the sum below.
const GROOVES: u32 = 64;

/// The intensity that a grating sends to an angle, from 0 to 1, by adding the waves of its grooves.
pub fn sum_of_grooves(sin_i: f64, sine: f64, lambda_nm: f64, pitch_nm: f64) -> f64 {
    let step = Complex::phase(2.0 * PI * pitch_nm * (sine - sin_i) / lambda_nm);
    let (mut sum, mut wave) = (Complex::ZERO, Complex::real(1.0));
    for _ in 0..GROOVES {
        sum = sum + wave;
        wave = wave * step;
    }
    sum.square() / f64::from(GROOVES * GROOVES)
}

/// The sines of all angles to which a grating sends most light, found by looking everywhere.
pub fn brightest_sines(sin_i: f64, lambda_nm: f64, pitch_nm: f64) -> Vec<f64> {
    const PLACES: i32 = 4000;
    let at = |place: i32| f64::from(place) / f64::from(PLACES);
    let intensity = |sine: f64| sum_of_grooves(sin_i, sine, lambda_nm, pitch_nm);
    let is_peak = |place: &i32| {
        let here = intensity(at(*place));
        here > 0.5 && here >= intensity(at(place - 1)) && here > intensity(at(place + 1))
    };
    let refined = |place: i32| {
        let (mut low, mut high) = (at(place - 1), at(place + 1));
        while high - low > 1e-10 {
            let third = (high - low) / 3.0;
            if intensity(low + third) > intensity(high - third) { high -= third } else { low += third }
        }
        0.5 * (low + high)
    };
    (-PLACES..=PLACES).filter(is_peak).map(refined).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn soap(thickness_nm: f64) -> ThinFilm {
        ThinFilm { index: 1.333, index_below: 1.0, thickness_nm }
    }

    /// Issue 21: Airy's reflectance at 20 wavelengths to 1e-6, by his formula for a film between equal media.
    #[test]
    fn reflectance_is_airys_at_20_wavelengths() {
        for (thickness, cos_i) in [(300.0, 1.0), (650.0, 0.8), (1000.0, 0.3)] {
            let boundaries = soap(thickness).boundaries(cos_i);
            let t = (1.0 - (1.0 - cos_i * cos_i) / 1.333_f64.powi(2)).sqrt();
            let [s, p] = gonio_light::optics::polarised_dielectric(cos_i, 1.0 / 1.333);
            for lambda in (0..20).map(|i| 385.0 + 20.0 * f64::from(i)) {
                let sin2 = (TAU * 1.333 * thickness * t / lambda).sin().powi(2);
                let airy = |r: f64| {
                    let finesse = 4.0 * r / (1.0 - r).powi(2);
                    finesse * sin2 / (1.0 + finesse * sin2)
                };
                let expected = 0.5 * (airy(s) + airy(p));
                assert!((boundaries.reflectance(lambda) - expected).abs() < 1e-6, "{thickness} {cos_i} {lambda}");
                assert!((boundaries.sum_of_waves(lambda, 80) - expected).abs() < 1e-6, "{thickness} {cos_i} {lambda}");
            }
        }
    }

    /// A film far thinner than light waves reflects nothing (Newton's black spot); one of no thickness on water reflects as
    /// water does.
    #[test]
    fn films_without_thickness_have_no_effect() {
        assert!(soap(1.0).boundaries(0.7).reflectance(550.0) < 1e-3);
        let oil = ThinFilm { index: 1.47, index_below: 1.333, thickness_nm: 0.0 };
        let water = gonio_light::optics::dielectric(0.6, 1.0 / 1.333);
        assert!((oil.boundaries(0.6).reflectance(550.0) - water).abs() < 1e-9);
    }

    /// Half a wave of path that is lost at one surface only: dark where 2 n d is a wavelength, bright at half of it.
    #[test]
    fn a_film_is_dark_where_its_path_is_a_wavelength() {
        let thickness = 550.0 / (2.0 * 1.333);
        assert!(soap(thickness).boundaries(1.0).reflectance(550.0) < 1e-9);
        let quarter = soap(0.5 * thickness).boundaries(1.0).reflectance(550.0);
        let r = gonio_light::optics::dielectric(1.0, 1.0 / 1.333);
        assert!((quarter - 4.0 * r / (1.0 + r).powi(2)).abs() < 1e-9, "{quarter}");
    }

    #[test]
    fn a_grating_sends_light_to_the_orders_of_its_equation() {
        for (sin_i, lambda, pitch) in [(0.0, 550.0, 1600.0), (0.3, 650.0, 1600.0), (-0.2, 450.0, 740.0)] {
            let found = brightest_sines(sin_i, lambda, pitch);
            let orders: Vec<f64> = (-9..=9).filter_map(|m| order_sine(sin_i, m, lambda, pitch)).collect();
            assert_eq!(found.len(), orders.len(), "{sin_i} {lambda} {pitch}");
            for (found, order) in found.iter().zip(&orders) {
                // The top of a peak is flat: its place is known to the root of the rounding.
                assert!((found - order).abs() < 1e-6, "{found} {order}");
            }
        }
    }
}
