//! Translucent media: measured coefficients, a random walk, and laws of a deep medium.

use crate::random::{free_path, on_sphere};
use glam::DVec3;
use gonio_bsdf::sampling::SplitMix;
use std::f64::consts::{FRAC_PI_2, PI};

/// A medium with isotropic scattering, for red, green and blue light.
///
/// Real media scatter forwards. The reduced coefficient is that of isotropic scattering with the same effect after several
/// events (similarity theory).
#[derive(Clone, Copy, Debug)]
pub struct TranslucentMedium {
    /// The name.
    pub name: &'static str,
    /// Reduced scattering coefficients, 1/mm.
    pub scattering: DVec3,
    /// Absorption coefficients, 1/mm.
    pub absorption: DVec3,
}

const fn measured(name: &'static str, scattering: [f64; 3], absorption: [f64; 3]) -> TranslucentMedium {
    TranslucentMedium { name, scattering: DVec3::from_array(scattering), absorption: DVec3::from_array(absorption) }
}

/// Source of all: H. W. Jensen, S. R. Marschner, M. Levoy and P. Hanrahan, *A Practical Model for Subsurface Light Transport*,
/// SIGGRAPH 2001, figure 5.
pub const MARBLE: TranslucentMedium = measured("marble", [2.19, 2.62, 3.00], [0.0021, 0.0041, 0.0071]);
/// Milk without fat.
pub const SKIM_MILK: TranslucentMedium = measured("skim milk", [0.70, 1.22, 1.90], [0.0014, 0.0025, 0.0142]);
/// The first sample of skin.
pub const SKIN: TranslucentMedium = measured("skin", [0.74, 0.88, 1.01], [0.032, 0.17, 0.48]);
/// A potato.
pub const POTATO: TranslucentMedium = measured("potato", [0.68, 0.70, 0.55], [0.0024, 0.0090, 0.12]);

impl TranslucentMedium {
    /// Extinction of a channel in 1/mm, and the share of it that is scattering (the albedo of an event).
    pub fn channel(&self, channel: usize) -> [f64; 2] {
        let extinction = self.scattering[channel] + self.absorption[channel];
        [extinction, self.scattering[channel] / extinction]
    }
}

/// Where a walk is followed no further although it is inside: it carries less light than this.
const LEAST_WEIGHT: f64 = 1e-9;
/// Below this weight a walk goes on with this chance.
const ROULETTE: f64 = 0.25;

/// A walk that left its body.
#[derive(Clone, Copy, Debug)]
pub struct WalkExit {
    /// The place on the surface.
    pub point: DVec3,
    /// The direction.
    pub direction: DVec3,
    /// The share of the light that was not absorbed.
    pub weight: f64,
}

/// A scattering event of a walk.
#[derive(Clone, Copy, Debug)]
pub struct WalkEvent {
    /// The place.
    pub point: DVec3,
    /// A lower bound of its distance to the surface.
    pub depth: f64,
    /// The share of the light that was not absorbed, here included.
    pub weight: f64,
}

/// The distance along a ray from inside a body to its surface, or `reach` if that is less.
///
/// `distance` is a lower bound of the distance to the surface, negative inside.
pub fn distance_inside(
    distance: &impl Fn(DVec3) -> f64,
    from: DVec3,
    direction: DVec3,
    reach: f64,
    precision: f64,
) -> f64 {
    let mut passed = 0.0;
    while passed < reach {
        let free = -distance(from + direction * passed);
        if free < precision {
            return passed;
        }
        passed += free;
    }
    reach
}

/// A random walk through a body from a point inside: free paths, absorption, isotropic scattering. At each event
/// `scattered` is called. The boundary neither reflects nor refracts.
///
/// `distance` is a lower bound of the distance to the surface, negative inside; lengths are in the unit of `1 / extinction`.
pub fn walk(
    distance: &impl Fn(DVec3) -> f64,
    start: [DVec3; 2],
    [extinction, albedo]: [f64; 2],
    precision: f64,
    random: &mut SplitMix,
    mut scattered: impl FnMut(WalkEvent, &mut SplitMix),
) -> Option<WalkExit> {
    let [mut point, mut direction] = start;
    let mut weight = 1.0;
    let mut depth = -distance(point);
    loop {
        let flight = free_path(random) / extinction;
        // Most flights end long before the surface.
        if flight > depth {
            let passed = distance_inside(distance, point, direction, flight, precision);
            if passed < flight {
                return Some(WalkExit { point: point + direction * passed, direction, weight });
            }
        }
        point += direction * flight;
        depth = -distance(point);
        weight *= albedo;
        if weight < ROULETTE {
            if random.next_number() >= ROULETTE || weight < LEAST_WEIGHT {
                return None;
            }
            weight /= ROULETTE;
        }
        scattered(WalkEvent { point, depth, weight }, random);
        direction = on_sphere(random);
    }
}

/// Chandrasekhar's H function of isotropic scattering, in closed form.
///
/// `H(mu) = exp(-mu / pi  integral from 0 to infinity of  ln(1 - w arctan(k) / k) / (1 + mu^2 k^2) dk)`
///
/// Source: S. Chandrasekhar, *Radiative Transfer*, 1950, chapter V; the integral over k: V. Kourganoff, *Basic Methods in Transfer
/// Problems*, 1952.
pub fn h_function(mu: f64, albedo: f64) -> f64 {
    // k = tan(x) makes the range finite. Midpoints: the integrand has a peak at 0 if the albedo is almost 1.
    const STEPS: u32 = 4000;
    let integrand = |s: f64| {
        // x = (pi / 2) s^3 puts most points near 0.
        let x = FRAC_PI_2 * s.powi(3);
        let k = x.tan();
        let ratio = if k < 1e-6 { 1.0 } else { x / k };
        let width = FRAC_PI_2 * 3.0 * s * s;
        (1.0 - albedo * ratio).ln() / (x.cos().powi(2) + mu * mu * x.sin().powi(2)) * width
    };
    let sum: f64 = (0..STEPS).map(|step| integrand((f64::from(step) + 0.5) / f64::from(STEPS))).sum();
    (-mu / PI * sum / f64::from(STEPS)).exp()
}

/// The share of light that a half space reflects, where it arrives at an angle with the cosine `mu`.
pub fn reflectance(mu: f64, albedo: f64) -> f64 {
    1.0 - (1.0 - albedo).sqrt() * h_function(mu, albedo)
}

/// The share of light that a half space reflects, where the same radiance arrives from everywhere.
pub fn diffuse_reflectance(albedo: f64) -> f64 {
    const STEPS: u32 = 64;
    let mean = |step: u32| {
        let mu = (f64::from(step) + 0.5) / f64::from(STEPS);
        2.0 * mu * reflectance(mu, albedo)
    };
    (0..STEPS).map(mean).sum::<f64>() / f64::from(STEPS)
}

/// The diffusion approximation with two sources: light that leaves at the distance `r` from where it entered, per area.
///
/// Source: H. W. Jensen et al., SIGGRAPH 2001, (4), for a boundary that does not reflect.
#[derive(Clone, Copy, Debug)]
pub struct Dipole {
    albedo: f64,
    /// Depth of the real source, height of the virtual one, and the rate of decay.
    real: f64,
    above: f64,
    decay: f64,
}

impl Dipole {
    /// The dipole of a medium.
    pub fn new([extinction, albedo]: [f64; 2]) -> Self {
        let real = 1.0 / extinction;
        Self {
            albedo,
            real,
            above: real * (1.0 + 4.0 / 3.0),
            decay: (3.0 * (1.0 - albedo) * extinction * extinction).sqrt(),
        }
    }

    /// The profile at a distance.
    pub fn profile(&self, r: f64) -> f64 {
        let source = |z: f64| {
            let d = r.hypot(z);
            z * (1.0 + self.decay * d) * (-self.decay * d).exp() / d.powi(3)
        };
        self.albedo / (4.0 * PI) * (source(self.real) + source(self.above))
    }

    /// The sum of the profile over the plane: the total reflectance.
    pub fn total(&self) -> f64 {
        let a = (3.0 * (1.0 - self.albedo)).sqrt();
        0.5 * self.albedo * (1.0 + (-4.0 / 3.0 * a).exp()) * (-a).exp()
    }

    /// Two lengths over which the profile falls: near the place of entry, and far away.
    pub fn lengths(&self) -> [f64; 2] {
        [2.0 * self.real, (1.0 / self.decay).min(30.0 * self.real)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::mean_of;

    /// The moments of H in closed form: the integral of H is 2 (1 - sqrt(1 - w)) / w.
    #[test]
    fn the_h_function_has_its_moment() {
        for albedo in [0.2, 0.7, 0.95, 0.999] {
            let sum: f64 = (0..400).map(|i| h_function((f64::from(i) + 0.5) / 400.0, albedo) / 400.0).sum();
            let expected = 2.0 * (1.0 - (1.0_f64 - albedo).sqrt()) / albedo;
            assert!((sum - expected).abs() < 1e-4 * expected, "{albedo}: {sum} {expected}");
        }
        // Chandrasekhar's table XI: albedo 1 at the zenith.
        assert!((h_function(1.0, 1.0 - 1e-12) - 2.9078).abs() < 1e-3);
    }

    /// Issue 21: total reflectance of a half space, by walks.
    #[test]
    fn a_deep_medium_reflects_as_the_h_function_says() {
        for (albedo, mu) in [(0.3, 1.0), (0.8, 0.5), (0.95, 1.0), (0.95, 0.2)] {
            let start = [DVec3::new(0.0, -2e-9, 0.0), DVec3::new((1.0_f64 - mu * mu).sqrt(), -mu, 0.0)];
            let mut random = SplitMix::new(5);
            let reflected = (0..60_000).map(|_| {
                walk(&|p: DVec3| p.y, start, [2.0, albedo], 1e-9, &mut random, |_, _| ())
                    .map_or(0.0, |exit| exit.weight)
            });
            let [mean, error] = mean_of(reflected);
            assert!((mean - reflectance(mu, albedo)).abs() < 4.0 * error, "{albedo} {mu}: {mean} {error}");
        }
    }

    #[test]
    fn the_dipole_sums_to_its_total() {
        for channel in 0..3 {
            let dipole = Dipole::new(SKIN.channel(channel));
            let step = 0.002;
            let sum: f64 = (0..200_000)
                .map(|i| step * (f64::from(i) + 0.5))
                .map(|r| 2.0 * PI * r * step * dipole.profile(r))
                .sum();
            assert!((sum - dipole.total()).abs() < 1e-4, "{sum} {}", dipole.total());
        }
    }
}
