//! Phosphors: light that is stored while a lamp shines and emitted afterwards.

use crate::bands::{BANDS, BandSpectrum, band_lambda, color_of_light, in_gamut};
use glam::DVec3;

/// A phosphor with one decay time.
///
/// Its traps fill while the lamp is on and empty by themselves. With the share `n` of traps that are full:
///
/// ```text
/// dn/dt = p (1 - n) - n / tau    (lamp on)        dn/dt = -n / tau    (lamp off)
/// ```
///
/// Each trap that empties emits a photon. Real phosphors have several decay times, from seconds to hours; this is one of them.
///
/// Source: G. Blasse and B. C. Grabmaier, *Luminescent Materials*, 1994, section 3.4.
#[derive(Clone, Copy, Debug)]
pub struct Phosphor {
    /// The name.
    pub name: &'static str,
    /// The decay time tau, s.
    pub decay_s: f64,
    /// Middle and width of the emission, nm.
    pub emission: [f64; 2],
}

/// Luminance 1 is about that of a green band with this sum over the bands.
const BRIGHTNESS: f64 = 14.0;

/// Traps filled per second by the lamp, as a share of the empty ones.
pub const PUMP: f64 = 0.8;

/// Strontium aluminate with europium and dysprosium; blue-green, blue and red ones. Emission: T. Matsuzawa et al.,
/// Journal of the Electrochemical Society 143, 1996, and Y. Lin et al., Journal of Alloys and Compounds 348, 2003. The times are chosen so
/// that a minute shows their order.
pub const GREEN: Phosphor = Phosphor { name: "SrAl2O4:Eu,Dy (green)", decay_s: 22.0, emission: [520.0, 28.0] };
/// Strontium aluminate of another structure.
pub const AQUA: Phosphor = Phosphor { name: "Sr4Al14O25:Eu,Dy (aqua)", decay_s: 14.0, emission: [490.0, 22.0] };
/// Calcium aluminate.
pub const BLUE: Phosphor = Phosphor { name: "CaAl2O4:Eu,Nd (blue)", decay_s: 8.0, emission: [442.0, 18.0] };
/// Yttrium oxysulphide.
pub const RED: Phosphor = Phosphor { name: "Y2O2S:Eu,Mg,Ti (red)", decay_s: 4.0, emission: [624.0, 8.0] };

/// All of them.
pub const ALL: [Phosphor; 4] = [GREEN, AQUA, BLUE, RED];

impl Phosphor {
    /// The share of full traps at `time_s`, where the lamp is on from `-charge_s` to 0.
    pub fn filled(&self, time_s: f64, charge_s: f64) -> f64 {
        let rate = PUMP + 1.0 / self.decay_s;
        let charged = |duration: f64| PUMP / rate * (1.0 - (-rate * duration.max(0.0)).exp());
        if time_s <= 0.0 { charged(charge_s + time_s) } else { charged(charge_s) * (-time_s / self.decay_s).exp() }
    }

    /// Photons per second and trap.
    pub fn emitted(&self, time_s: f64, charge_s: f64) -> f64 {
        self.filled(time_s, charge_s) / self.decay_s
    }

    /// The colour of its light, for equal numbers of photons of all phosphors; about 1 for green ones.
    pub fn color(&self) -> DVec3 {
        let [center, width] = self.emission;
        let mut light: BandSpectrum = [0.0; BANDS];
        for (band, light) in light.iter_mut().enumerate() {
            *light = (-0.5 * ((band_lambda(band) - center) / width).powi(2)).exp();
        }
        // A photon's energy falls with its wavelength.
        let all: f64 = light.iter().sum::<f64>() * center / 520.0;
        in_gamut(color_of_light(&light.map(|light| BRIGHTNESS * light / all)))
    }

    /// The equation above by small steps (fourth order of Runge and Kutta), from an empty phosphor: the share of full traps at
    /// `time_s`, all photons absorbed since the lamp was lit, and all emitted.
    pub fn simulated(&self, time_s: f64, charge_s: f64) -> [f64; 3] {
        const STEP_S: f64 = 0.01;
        let mut filled = 0.0;
        let (mut absorbed, mut emitted) = (0.0, 0.0);
        // The lamp's end is the end of a step.
        for (pump, duration) in [(PUMP, (charge_s + time_s.min(0.0)).max(0.0)), (0.0, time_s.max(0.0))] {
            let steps = (duration / STEP_S).ceil().max(1.0);
            let step = duration / steps;
            let slope = |n: f64| pump * (1.0 - n) - n / self.decay_s;
            for _ in 0..steps as u64 {
                let k1 = slope(filled);
                let k2 = slope(filled + 0.5 * step * k1);
                let k3 = slope(filled + 0.5 * step * k2);
                let k4 = slope(filled + step * k3);
                let next = filled + step / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
                // Simpson's rule needs the middle of the step.
                let middle = 0.5 * (filled + next) + step / 8.0 * (k1 - k4);
                let mean = (filled + 4.0 * middle + next) / 6.0;
                absorbed += step * pump * (1.0 - mean);
                emitted += step * mean / self.decay_s;
                filled = next;
            }
        }
        [filled, absorbed, emitted]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Issue 21: exponential decay, found by small steps.
    #[test]
    fn the_glow_decays_exponentially() {
        for phosphor in ALL {
            let at = |time: f64| phosphor.simulated(time, 6.0)[0];
            let ratio = at(3.0 + phosphor.decay_s) / at(3.0);
            assert!((ratio - (-1.0_f64).exp()).abs() < 1e-8, "{}: {ratio}", phosphor.name);
            for time in [-3.0, -0.5, 0.0, 1.0, 20.0] {
                assert!((at(time) - phosphor.filled(time, 6.0)).abs() < 1e-8, "{} at {time}", phosphor.name);
            }
        }
    }

    /// Each absorbed photon is emitted, or its trap is still full.
    #[test]
    fn no_photon_is_lost() {
        for phosphor in ALL {
            for time in [-2.0, 0.0, 5.0, 60.0] {
                let [filled, absorbed, emitted] = phosphor.simulated(time, 6.0);
                assert!((absorbed - emitted - filled).abs() < 1e-8, "{} at {time}", phosphor.name);
            }
            let [_, absorbed, emitted] = phosphor.simulated(20.0 * phosphor.decay_s, 6.0);
            assert!((absorbed - emitted).abs() < 1e-7 * absorbed, "{}", phosphor.name);
        }
    }
}
