//! Special relativity of light: Doppler factor, aberration, and the light that a moving observer sees. `c` is 1.
//!
//! *Sources*: A. Einstein, *Zur Elektrodynamik bewegter Körper*, Annalen der Physik 17, 1905, sections 3, 7 and 8; D. Weiskopf,
//! U. Kraus and H. Ruder, *Searchlight and Doppler Effects in the Visualization of Special Relativity*, ACM Transactions on Graphics
//! 18(3), 1999.

use crate::bands::{BANDS, BandSpectrum, band_lambda, color_of_light, in_gamut};
use glam::{DVec3, DVec4};

/// The effects that can be switched.
#[derive(Clone, Copy, Debug)]
pub struct Effects {
    /// The speed as a share of that of light, 0 to below 1.
    pub speed: f64,
    /// Wavelengths are shifted.
    pub doppler: bool,
    /// The number of photons changes: they arrive more often, and from a smaller cone.
    pub searchlight: bool,
    /// Directions change: light needs time.
    pub aberration: bool,
}

/// `1 / sqrt(1 - v^2)`
pub fn gamma(speed: f64) -> f64 {
    1.0 / (1.0 - speed * speed).sqrt()
}

/// An event `(x, y, z, t)` in a frame that moves with `speed` along x. Source: Einstein 1905, section 3.
pub fn boost(event: DVec4, speed: f64) -> DVec4 {
    let gamma = gamma(speed);
    DVec4::new(gamma * (event.x - speed * event.w), event.y, event.z, gamma * (event.w - speed * event.x))
}

/// The observed frequency over the emitted one, `D = 1 / (gamma (1 - v cos))`; `cos`: of the angle in the observer's frame between
/// the direction of sight and that in which the observer moves towards the source (or against that in which the source moves).
pub fn doppler_factor(speed: f64, cos: f64) -> f64 {
    1.0 / (gamma(speed) * (1.0 - speed * cos))
}

/// The cosine in the frame of the sources, for a direction of sight with `cos` in the observer's, both to the direction of the
/// observer's motion: `(cos - v) / (1 - v cos)`.
pub fn aberrated_cos(speed: f64, cos: f64) -> f64 {
    (cos - speed) / (1.0 - speed * cos)
}

/// The direction in the frame of the sources for a direction of sight of an observer who moves along `forward`.
pub fn aberrated(direction: DVec3, forward: DVec3, speed: f64) -> DVec3 {
    let cos = direction.dot(forward);
    let across = (direction - cos * forward).normalize_or_zero();
    let seen = aberrated_cos(speed, cos);
    forward * seen + across * (1.0 - seen * seen).max(0.0).sqrt()
}

impl Effects {
    /// The factor of spectral radiance beside the shift: `L_lambda = factor L'_(D lambda)`.
    ///
    /// All effects together give `D^5`. The shift itself gives `D^2`: photons of more energy, in a narrower band of wavelengths.
    /// The rest is the number of photons: `D` for their rate and `D^2` for the solid angle.
    pub fn factor(&self, d: f64) -> f64 {
        (if self.doppler { d * d } else { 1.0 }) * (if self.searchlight { d * d * d } else { 1.0 })
    }
}

/// Planck's law at 5800 K relative to 560 nm; `lambda` in nm, also far beyond the visible.
pub fn sunlight(lambda: f64) -> f64 {
    /// `h c / (k T)`, nm.
    const SCALE: f64 = 1.438_776_877e7 / 5800.0;
    let planck = |lambda: f64| 1.0 / (lambda.powi(5) * (SCALE / lambda).exp_m1());
    planck(lambda) / planck(560.0)
}

/// Entries of a table of colours, and the largest logarithm of the Doppler factor to either side.
const ENTRIES: usize = 256;
const MOST_LOG: f64 = 3.2;

/// The colour of a material in sunlight over the Doppler factor.
#[derive(Clone, Debug)]
pub struct ShiftedColors {
    colors: Vec<DVec3>,
}

impl ShiftedColors {
    /// `radiance`: relative to sunlight, of the wavelength in nm.
    pub fn new(effects: &Effects, radiance: impl Fn(f64) -> f64) -> Self {
        let white: BandSpectrum = std::array::from_fn(|band| sunlight(band_lambda(band)));
        let white = color_of_light(&white);
        let colors = (0..=ENTRIES).map(|entry| {
            let d = (MOST_LOG * (2.0 * entry as f64 / ENTRIES as f64 - 1.0)).exp();
            let shift = if effects.doppler { d } else { 1.0 };
            let mut light: BandSpectrum = [0.0; BANDS];
            for (band, light) in light.iter_mut().enumerate() {
                let lambda = band_lambda(band) * shift;
                *light = effects.factor(d) * sunlight(lambda) * radiance(lambda);
            }
            // The camera's white is sunlight.
            in_gamut(color_of_light(&light) / white)
        });
        Self { colors: colors.collect() }
    }

    /// The colour at a Doppler factor.
    pub fn at(&self, d: f64) -> DVec3 {
        let place = (d.ln() / MOST_LOG + 1.0) * 0.5 * ENTRIES as f64;
        let place = place.clamp(0.0, ENTRIES as f64 - 1e-9);
        let entry = place as usize;
        self.colors[entry].lerp(self.colors[entry + 1], place - entry as f64)
    }
}

/// The Doppler factor by two crests of a wave. A source passes at distance 1; its crests leave at two near proper times, and the light
/// needs time to the observer. `along`: the source's place, in its direction of motion, when the first crest leaves.
/// Returns the factor and the cosine to the direction from which the source comes.
pub fn doppler_by_crests(speed: f64, along: f64) -> [f64; 2] {
    const PERIOD: f64 = 1e-4;
    // Between the crests the source is as far before as behind `along`.
    let arrival = |proper: f64| {
        let time = gamma(speed) * proper;
        let place = along + speed * time;
        time + (1.0 + place * place).sqrt()
    };
    let observed = arrival(0.5 * PERIOD) - arrival(-0.5 * PERIOD);
    [PERIOD / observed, -along / (1.0 + along * along).sqrt()]
}

/// The cosine in the frame of the sources, by two events on the path of a photon that an observer sees at `cos`.
pub fn aberration_by_events(speed: f64, cos: f64) -> f64 {
    // The photon is at (cos, sin) at time -1 and at the observer at time 0; the sources move against the observer.
    let before = boost(DVec4::new(cos, (1.0 - cos * cos).sqrt(), 0.0, -1.0), -speed);
    let path = before.truncate();
    path.x / path.length()
}

/// The energy density that an observer with `speed` finds in a field that is the same in all directions and has density 1 at
/// rest, by the sum over directions.
pub fn energy_density(speed: f64) -> f64 {
    const RINGS: u32 = 20_000;
    // The middle of each ring of equal solid angle; radiance of all wavelengths grows as D^4.
    let ring = |index: u32| doppler_factor(speed, 2.0 * (f64::from(index) + 0.5) / f64::from(RINGS) - 1.0).powi(4);
    (0..RINGS).map(ring).sum::<f64>() / f64::from(RINGS)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SPEEDS: [f64; 5] = [0.0, 0.1, 0.5, 0.8, 0.9];

    /// Issue 21: Doppler factor and aberration angle to 1e-6.
    #[test]
    fn crests_and_photons_obey_einsteins_formulas() {
        for speed in SPEEDS {
            for along in [-9.0, -2.0, -0.5, 0.0, 0.7, 3.0] {
                let [found, cos] = doppler_by_crests(speed, along);
                assert!((found - doppler_factor(speed, cos)).abs() < 1e-6, "{speed} {along} {found}");
            }
            for cos in (0..20).map(|index| 0.1 * f64::from(index) - 0.95) {
                let found = aberration_by_events(speed, cos);
                assert!((found - aberrated_cos(speed, cos)).abs() < 1e-9, "{speed} {cos}");
                let sight = DVec3::new((1.0 - cos * cos).sqrt(), 0.0, -cos);
                let seen = aberrated(sight, DVec3::NEG_Z, speed);
                assert!((-seen.z - found).abs() < 1e-9 && (seen.length() - 1.0).abs() < 1e-12);
            }
        }
    }

    /// Issue 21: flux. An even field has the energy density `gamma^2 (1 + v^2 / 3)` for who moves in it.
    #[test]
    fn an_even_field_becomes_denser_for_who_moves_in_it() {
        for speed in SPEEDS {
            let expected = gamma(speed).powi(2) * (1.0 + speed * speed / 3.0);
            assert!((energy_density(speed) / expected - 1.0).abs() < 1e-6, "{speed}");
        }
    }

    /// A black body that is seen with the Doppler factor D is a black body of D times the temperature.
    #[test]
    fn a_shifted_black_body_is_a_black_body() {
        let effects = Effects { speed: 0.5, doppler: true, searchlight: true, aberration: true };
        for (d, lambda) in [(1.5, 500.0), (0.7, 650.0), (2.5, 420.0)] {
            let seen = effects.factor(d) * sunlight(lambda * d);
            let scale = 1.438_776_877e7 / (5800.0 * d);
            let hot = 1.0 / (f64::powi(lambda, 5) * f64::exp_m1(scale / lambda));
            let rest = 1.0 / (560.0_f64.powi(5) * (1.438_776_877e7 / 5800.0 / 560.0_f64).exp_m1());
            assert!((seen / (hot / rest) - 1.0).abs() < 1e-12, "{d} {lambda}");
        }
    }

    #[test]
    fn nothing_changes_at_rest() {
        let effects = Effects { speed: 0.0, doppler: true, searchlight: true, aberration: true };
        let color = ShiftedColors::new(&effects, |_| 0.5).at(doppler_factor(0.0, 0.3));
        assert!((color - 0.5).abs().max_element() < 1e-6, "{color}");
    }
}
