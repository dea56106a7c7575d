//! Focused beams, and light that grows with the square of light.

use std::f64::consts::PI;

/// A laser beam with a focus at z = 0. Lengths in any one unit.
///
/// ```text
/// I(r, z) = 2 P / (pi w^2) e^(-2 r^2 / w^2)     w(z) = w_0 sqrt(1 + (z / z_R)^2)
/// ```
///
/// Source: H. Kogelnik and T. Li, *Laser Beams and Resonators*, Applied Optics 5(10), 1966, (20) and (24).
#[derive(Clone, Copy, Debug)]
pub struct GaussianBeam {
    /// P.
    pub power: f64,
    /// `w_0`, the radius at the focus.
    pub waist: f64,
    /// `z_R`, the distance at which the area is twice that at the focus.
    pub rayleigh_range: f64,
}

impl GaussianBeam {
    /// `w(z)`
    pub fn radius(&self, z: f64) -> f64 {
        self.waist * (1.0 + (z / self.rayleigh_range).powi(2)).sqrt()
    }

    /// `I(r, z)`
    pub fn intensity(&self, r: f64, z: f64) -> f64 {
        let square = self.radius(z).powi(2);
        2.0 * self.power / (PI * square) * (-2.0 * r * r / square).exp()
    }

    /// The integral of `I^photons` along a line of sight across the beam, at distance `x` from its axis.
    pub fn seen(&self, photons: i32, x: f64, z: f64) -> f64 {
        let square = self.radius(z).powi(2) / f64::from(photons);
        // A product of bells is a bell: exp(-2 y^2 / square) has the integral sqrt(pi square / 2).
        self.intensity(x, z).powi(photons) * (0.5 * PI * square).sqrt()
    }

    /// The glow of a slice of unit length: `I^photons` summed over rings, for absorption of one or two photons at once.
    pub fn slice(&self, photons: i32, z: f64) -> f64 {
        const RINGS: u32 = 4000;
        let width = 6.0 * self.radius(z) / f64::from(RINGS);
        let ring = |index: u32| {
            let r = (f64::from(index) + 0.5) * width;
            2.0 * PI * r * width * self.intensity(r, z).powi(photons)
        };
        (0..RINGS).map(ring).sum()
    }

    /// The glow between `-reach` and `reach`, by Simpson's rule over slices.
    pub fn glow(&self, photons: i32, reach: f64) -> f64 {
        const SLICES: u32 = 100;
        let step = reach / f64::from(SLICES);
        let weight = |index: u32| match index {
            0 | SLICES => 1.0,
            odd if odd % 2 == 1 => 4.0,
            _ => 2.0,
        };
        // Both halves are equal.
        2.0 * (0..=SLICES).map(|i| weight(i) * self.slice(photons, f64::from(i) * step)).sum::<f64>() * step / 3.0
    }
}

/// The power of the second harmonic that a crystal makes of a power, `P tanh^2(k sqrt(P) L)`; `coupling` is `k L`.
///
/// Source: J. A. Armstrong et al., *Interactions between Light Waves in a Nonlinear Dielectric*, Physical Review 127, 1962, (5.11).
pub fn second_harmonic(power: f64, coupling: f64) -> f64 {
    power * (coupling * power.sqrt()).tanh().powi(2)
}

/// The same by small steps through the crystal, for the amplitudes of both waves in phase: `a' = -k a b`, `b' = k a^2`. Returns the powers
/// of the first wave and of the second.
pub fn harmonic_by_steps(power: f64, coupling: f64) -> [f64; 2] {
    const STEPS: u32 = 2000;
    let step = coupling / f64::from(STEPS);
    let slope = |[a, b]: [f64; 2]| [-a * b, a * a];
    let moved = |[a, b]: [f64; 2], [da, db]: [f64; 2], by: f64| [a + by * da, b + by * db];
    let mut waves = [power.sqrt(), 0.0];
    for _ in 0..STEPS {
        let k1 = slope(waves);
        let k2 = slope(moved(waves, k1, 0.5 * step));
        let k3 = slope(moved(waves, k2, 0.5 * step));
        let k4 = slope(moved(waves, k3, step));
        for (index, wave) in waves.iter_mut().enumerate() {
            *wave += step / 6.0 * (k1[index] + 2.0 * k2[index] + 2.0 * k3[index] + k4[index]);
        }
    }
    waves.map(|wave| wave * wave)
}

#[cfg(test)]
mod tests {
    use super::*;

    const BEAM: GaussianBeam = GaussianBeam { power: 1.3, waist: 0.02, rayleigh_range: 0.2 };

    /// Issue 21: exponents 1 and 2.
    #[test]
    fn glow_grows_with_the_power_and_with_its_square() {
        let twice = GaussianBeam { power: 2.6, ..BEAM };
        for (photons, ratio) in [(1, 2.0), (2, 4.0)] {
            assert!((twice.glow(photons, 1.0) / BEAM.glow(photons, 1.0) - ratio).abs() < 1e-9, "{photons}");
        }
        // A crystal that uses up little of the light.
        let exponent = (second_harmonic(2e-6, 1.0) / second_harmonic(1e-6, 1.0)).log2();
        assert!((exponent - 2.0).abs() < 1e-5, "{exponent}");
    }

    /// Every slice absorbs the same by one photon; by two, the focus does: half lies within the Rayleigh range of a long vessel.
    #[test]
    fn two_photon_glow_is_confined_to_the_focus() {
        for z in [0.0, 0.2, 1.0] {
            // The rings end at six radii.
            assert!((BEAM.slice(1, z) / BEAM.power - 1.0).abs() < 1e-6, "{z}");
            let area = PI * BEAM.radius(z).powi(2);
            assert!((BEAM.slice(2, z) - BEAM.power.powi(2) / area).abs() < 1e-5 * BEAM.slice(2, z), "{z}");
        }
        let everything = BEAM.power.powi(2) / (PI * BEAM.waist.powi(2)) * PI * BEAM.rayleigh_range;
        assert!((BEAM.glow(2, BEAM.rayleigh_range) / everything - 0.5).abs() < 1e-5);
    }

    #[test]
    fn lines_of_sight_add_up_to_slices() {
        for photons in [1, 2] {
            let width = 0.001;
            let sum: f64 = (-400..=400).map(|i| width * BEAM.seen(photons, f64::from(i) * width, 0.3)).sum();
            assert!((sum / BEAM.slice(photons, 0.3) - 1.0).abs() < 1e-5, "{photons}");
        }
    }

    #[test]
    fn the_harmonic_takes_its_power_from_the_first_wave() {
        for (power, coupling) in [(0.01, 1.0), (1.0, 0.5), (1.0, 2.0), (4.0, 1.5)] {
            let [first, second] = harmonic_by_steps(power, coupling);
            assert!((first + second - power).abs() < 1e-9, "{power} {coupling}");
            assert!((second - second_harmonic(power, coupling)).abs() < 1e-9, "{power} {coupling}");
        }
    }
}
