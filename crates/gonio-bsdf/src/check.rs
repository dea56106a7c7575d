//! Properties that every physically plausible BSDF has, each measured and judged.
//!
//! | property | measured | passes |
//! |---|---|---|
//! | reciprocity | largest relative difference of `f(wi, wo) / n_o^2` and `f(wo, wi) / n_i^2` | up to 0.1 % |
//! | energy | largest share of the light from one direction that is scattered | up to 1.005 |
//! | positivity | smallest value, and the number of values that are not finite | not negative, all finite |
//! | normalisation | integral of the density of the samples, and the share of samples that are lost | 1 within 0.01 |
//! | sampling | chi-square of 100,000 samples against the density, in 512 cells | p above 0.001 |

use crate::bsdf::Bsdf;
use crate::integrate::{directional_albedo, over_cell};
use crate::sampling::{SplitMix, direction};
use gonio_light::DVec3;
use std::f64::consts::TAU;

/// Relative difference up to which a function counts as reciprocal: tables interpolate, and GLSL computes in `f32`.
pub const RECIPROCITY_TOLERANCE: f64 = 1e-3;
/// Albedo up to which energy counts as conserved: the integrals err by up to 0.005.
pub const ENERGY_TOLERANCE: f64 = 0.005;
/// Difference from 1 up to which a density counts as normalised.
pub const DENSITY_TOLERANCE: f64 = 0.01;
/// The smallest probability of a chi-square for samples that follow their density: one run in a thousand fails by chance,
/// but the seed is fixed.
pub const CHI_SQUARE_LEVEL: f64 = 1e-3;

/// A measured property.
#[derive(Clone, Debug, PartialEq)]
pub struct CheckedProperty {
    /// Its name.
    pub property: &'static str,
    /// Whether the function has it.
    pub passed: bool,
    /// The measured number.
    pub value: f64,
    /// The direction of the light at which it was measured, if it belongs to one.
    pub wi: Option<DVec3>,
    /// The direction of the viewer.
    pub wo: Option<DVec3>,
    /// One sentence.
    pub explanation: String,
}

/// Measures all properties. The last two belong to the sampling, which functions in files do not have.
pub fn check(bsdf: &dyn Bsdf) -> Vec<CheckedProperty> {
    CHECK_PARTS.iter().flat_map(|part| part(bsdf)).collect()
}

/// A part of [`check`].
pub type CheckPart = fn(&dyn Bsdf) -> Vec<CheckedProperty>;

/// The parts of [`check`] in order, for callers that do something else between them.
pub const CHECK_PARTS: [CheckPart; 4] =
    [|bsdf| vec![reciprocity(bsdf)], |bsdf| vec![energy(bsdf)], |bsdf| vec![positivity(bsdf)], of_samples];

/// The properties of the samples; none where they do not follow the function.
fn of_samples(bsdf: &dyn Bsdf) -> Vec<CheckedProperty> {
    if !bsdf.samples_follow_function() || is_smooth(bsdf) {
        return Vec::new();
    }
    let viewers = sampled_viewers(bsdf);
    vec![normalisation(&viewers), sampling(&viewers)]
}

/// Whether light leaves in single directions only.
fn is_smooth(bsdf: &dyn Bsdf) -> bool {
    bsdf.sample(direction(0.5, 0.0), [0.5, 0.5, 0.5]).is_some_and(|sample| sample.is_mirror)
}

/// Polar and azimuth angle in degrees.
pub fn angles_deg(w: DVec3) -> (f64, f64) {
    let azimuth = w.y.atan2(w.x).to_degrees();
    (w.z.clamp(-1.0, 1.0).acos().to_degrees(), if azimuth < 0.0 { azimuth + 360.0 } else { azimuth })
}

/// Pairs over the hemisphere, or the sphere for a function that transmits, with the mirror direction of each.
fn pairs(bsdf: &dyn Bsdf) -> Vec<(DVec3, DVec3)> {
    let polar = [1.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0, 85.0, 89.0].map(f64::to_radians);
    let around = |theta: f64| (0..12).map(move |i| direction(theta, 0.1 + TAU * f64::from(i) / 12.0));
    let above: Vec<DVec3> = polar.into_iter().flat_map(around).collect();
    let sphere = above.iter().map(|w| DVec3::new(w.x, w.y, -w.z));
    let all: Vec<DVec3> = if bsdf.transmits() { above.iter().copied().chain(sphere).collect() } else { above.clone() };
    let first = all.iter().step_by(6);
    first.flat_map(|wi| all.iter().map(|wo| (*wi, *wo)).chain([(*wi, DVec3::new(-wi.x, -wi.y, wi.z))])).collect()
}

fn reciprocity(bsdf: &dyn Bsdf) -> CheckedProperty {
    let pairs = pairs(bsdf);
    let reversed: Vec<_> = pairs.iter().map(|(wi, wo)| (*wo, *wi)).collect();
    let (forth, back) = (bsdf.evaluate_all(&pairs), bsdf.evaluate_all(&reversed));
    let mut worst = (0.0, None);
    for (((wi, wo), forth), back) in pairs.iter().zip(forth).zip(back) {
        let (forth, back) = (forth / bsdf.index(*wo).powi(2), back / bsdf.index(*wi).powi(2));
        for channel in 0..3 {
            let (a, b) = (forth[channel], back[channel]);
            let largest = a.abs().max(b.abs());
            // Values below are the rounding of f32.
            let difference = if largest > 1e-6 { (a - b).abs() / largest } else { 0.0 };
            if difference > worst.0 {
                worst = (difference, Some((*wi, *wo)));
            }
        }
    }
    let passed = worst.0 <= RECIPROCITY_TOLERANCE;
    let explanation = if passed {
        "f is the same when light and viewer change places".to_owned()
    } else {
        format!("f changes by up to {:.1} % when light and viewer change places", 100.0 * worst.0)
    };
    CheckedProperty {
        property: "reciprocity",
        passed,
        value: worst.0,
        wi: worst.1.map(|pair| pair.0),
        wo: worst.1.map(|pair| pair.1),
        explanation,
    }
}

/// The polar angles at which the energy is measured, in degrees.
pub const ENERGY_ANGLES_DEG: [f64; 12] = [0.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0, 85.0, 89.0, 89.9];

fn energy(bsdf: &dyn Bsdf) -> CheckedProperty {
    let azimuths: &[f64] = if bsdf.is_isotropic() { &[0.0] } else { &[0.0, 45.0, 90.0] };
    let mut worst = (f64::NEG_INFINITY, DVec3::Z);
    for theta in ENERGY_ANGLES_DEG {
        for azimuth in azimuths {
            let above = direction(theta.to_radians(), azimuth.to_radians());
            let below = DVec3::new(above.x, above.y, -above.z);
            let sides: &[DVec3] = if bsdf.transmits() { &[above, below] } else { &[above] };
            for w in sides {
                let albedo = directional_albedo(bsdf, *w).max_element();
                // NaN is worse than everything.
                if albedo > worst.0 || albedo.is_nan() {
                    worst = (albedo, *w);
                }
            }
            if theta == 0.0 {
                break;
            }
        }
    }
    let passed = worst.0 <= 1.0 + ENERGY_TOLERANCE;
    let (theta, _) = angles_deg(worst.1);
    let explanation = if passed {
        format!(
            "at most {:.1} % of the light is scattered, at an angle of incidence of {theta:.1} degrees",
            100.0 * worst.0
        )
    } else if worst.0.is_nan() {
        format!("the scattered light is infinite or not a number at an angle of incidence of {theta:.1} degrees")
    } else {
        format!(
            "{:.3} times the light that arrives is scattered at an angle of incidence of {theta:.1} degrees: energy is not conserved",
            worst.0
        )
    };
    CheckedProperty { property: "energy", passed, value: worst.0, wi: Some(worst.1), wo: None, explanation }
}

fn positivity(bsdf: &dyn Bsdf) -> CheckedProperty {
    let mut pairs = pairs(bsdf);
    // Exactly at the normal, angles between projections have no value.
    let slanted = direction(0.5, 1.0);
    pairs.extend([(DVec3::Z, slanted), (slanted, DVec3::Z), (DVec3::Z, DVec3::Z)]);
    let mut smallest = (f64::INFINITY, None);
    let (mut not_finite, mut place) = (0_usize, None);
    for ((wi, wo), value) in pairs.iter().zip(bsdf.evaluate_all(&pairs)) {
        if !value.is_finite() {
            not_finite += 1;
            place.get_or_insert((*wi, *wo));
        } else if value.min_element() < smallest.0 {
            smallest = (value.min_element(), Some((*wi, *wo)));
        }
    }
    let passed = not_finite == 0 && smallest.0 >= 0.0;
    let explanation = if let Some((wi, wo)) = place {
        let (light, viewer) = (angles_deg(wi).0, angles_deg(wo).0);
        format!(
            "{not_finite} of {} values are infinite or not a number, first with light at {light:.1} and viewer at {viewer:.1} degrees",
            pairs.len()
        )
    } else if passed {
        "no value is negative".to_owned()
    } else {
        format!("f falls to {:.3e} per steradian", smallest.0)
    };
    let place = place.or(smallest.1);
    CheckedProperty {
        property: "positivity",
        passed,
        value: smallest.0,
        wi: place.map(|pair| pair.0),
        wo: place.map(|pair| pair.1),
        explanation,
    }
}

/// Cells of the sphere: cosines and azimuths.
const CELLS: [usize; 2] = [16, 32];
const CHI_SQUARE_SAMPLES: u32 = 100_000;

/// Directions of the viewer at which the sampling is measured.
fn viewers(bsdf: &dyn Bsdf) -> Vec<DVec3> {
    let mut all = vec![direction(0.0, 0.0), direction(0.6, 0.3), direction(1.3, 2.0)];
    if bsdf.transmits() {
        all.extend([direction(2.7, 0.5), direction(2.0, 4.0)]);
    }
    all
}

/// The probability of each cell by the density, for one viewer.
fn expected(bsdf: &dyn Bsdf, wo: DVec3) -> Vec<f64> {
    let bottom = if bsdf.transmits() { -1.0 } else { 0.0 };
    let cos = |i: usize| bottom + (1.0 - bottom) * i as f64 / CELLS[0] as f64;
    let phi = |j: usize| TAU * j as f64 / CELLS[1] as f64;
    let density = |wi: DVec3| bsdf.density(wi, wo);
    let cell = |index: usize| {
        let (i, j) = (index / CELLS[1], index % CELLS[1]);
        over_cell(&density, [cos(i), cos(i + 1)], [phi(j), phi(j + 1)], 3e-6)
    };
    (0..CELLS[0] * CELLS[1]).map(cell).collect()
}

/// The samples of each cell, and the number of lost ones.
fn counted(bsdf: &dyn Bsdf, wo: DVec3, seed: u64) -> (Vec<u32>, u32) {
    let bottom = if bsdf.transmits() { -1.0 } else { 0.0 };
    let mut counts = vec![0; CELLS[0] * CELLS[1]];
    let mut lost = 0;
    let mut random = SplitMix::new(seed);
    for _ in 0..CHI_SQUARE_SAMPLES {
        let Some(sample) = bsdf.sample(wo, random.next_three()) else {
            lost += 1;
            continue;
        };
        let share = (sample.wi.z - bottom) / (1.0 - bottom);
        let turn = sample.wi.y.atan2(sample.wi.x) / TAU;
        let i = ((share * CELLS[0] as f64) as usize).min(CELLS[0] - 1);
        let j = (((turn - turn.floor()) * CELLS[1] as f64) as usize).min(CELLS[1] - 1);
        counts[i * CELLS[1] + j] += 1;
    }
    (counts, lost)
}

/// The samples for one viewer.
struct SampledViewer {
    wo: DVec3,
    expected: Vec<f64>,
    counts: Vec<u32>,
    lost: u32,
}

fn sampled_viewers(bsdf: &dyn Bsdf) -> Vec<SampledViewer> {
    let one = |(seed, wo): (u64, DVec3)| {
        let (counts, lost) = counted(bsdf, wo, seed);
        SampledViewer { wo, expected: expected(bsdf, wo), counts, lost }
    };
    (1..).zip(viewers(bsdf)).map(one).collect()
}

fn normalisation(viewers: &[SampledViewer]) -> CheckedProperty {
    let measured = viewers.iter().map(|viewer| {
        let integral: f64 = viewer.expected.iter().sum();
        (integral, f64::from(viewer.lost) / f64::from(CHI_SQUARE_SAMPLES), viewer.wo)
    });
    let error = |(integral, lost, _): &(f64, f64, DVec3)| (integral + lost - 1.0).abs();
    let worst = measured.max_by(|a, b| error(a).total_cmp(&error(b))).unwrap_or((1.0, 0.0, DVec3::Z));
    let (integral, lost, wo) = worst;
    CheckedProperty {
        property: "normalisation",
        passed: error(&worst) <= DENSITY_TOLERANCE,
        value: integral + lost,
        wi: None,
        wo: Some(wo),
        explanation: format!(
            "the density integrates to {integral:.4} and {:.1} % of the samples are lost, together {:.4}",
            100.0 * lost,
            integral + lost
        ),
    }
}

fn sampling(viewers: &[SampledViewer]) -> CheckedProperty {
    let results = viewers.iter().map(|viewer| {
        let result = chi_square(&viewer.counts, &viewer.expected, CHI_SQUARE_SAMPLES);
        (result.probability(), result, viewer.wo)
    });
    let least = results.min_by(|a, b| a.0.total_cmp(&b.0));
    let (p, result, wo) = least.unwrap_or((1.0, ChiSquare { statistic: 0.0, degrees: 0 }, DVec3::Z));
    CheckedProperty {
        property: "sampling",
        passed: p > CHI_SQUARE_LEVEL,
        value: p,
        wi: None,
        wo: Some(wo),
        explanation: format!(
            "chi-square {:.1} with {} degrees of freedom, p = {p:.3}",
            result.statistic, result.degrees
        ),
    }
}

/// A chi-square statistic.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChiSquare {
    /// The sum of squared differences over the expected counts.
    pub statistic: f64,
    /// Degrees of freedom.
    pub degrees: usize,
}

impl ChiSquare {
    /// The probability of a statistic at least this large by chance, by the approximation of E. B. Wilson and M. M. Hilferty
    /// (1931), which is exact to 0.001 from 10 degrees of freedom on. 1 without degrees of freedom.
    pub fn probability(self) -> f64 {
        if self.degrees == 0 {
            return 1.0;
        }
        let spread = 2.0 / (9.0 * self.degrees as f64);
        let z = ((self.statistic / self.degrees as f64).cbrt() - (1.0 - spread)) / spread.sqrt();
        0.5 * complementary_error(z / std::f64::consts::SQRT_2)
    }
}

/// Compares counts with their expected shares. Cells with fewer than 5 expected samples are put together.
fn chi_square(counts: &[u32], shares: &[f64], samples: u32) -> ChiSquare {
    let (mut statistic, mut cells) = (0.0, 0);
    let (mut few_counted, mut few_expected) = (0.0, 0.0);
    let term = |counted: f64, expected: f64| (counted - expected).powi(2) / expected;
    for (count, share) in counts.iter().zip(shares) {
        let (count, expected) = (f64::from(*count), share * f64::from(samples));
        if expected >= 5.0 {
            statistic += term(count, expected);
            cells += 1;
        } else {
            few_counted += count;
            few_expected += expected;
        }
    }
    if few_expected >= 5.0 {
        statistic += term(few_counted, few_expected);
        cells += 1;
    } else if few_counted > few_expected + 25.0 {
        // Many samples where next to none are expected.
        statistic = f64::INFINITY;
    }
    ChiSquare { statistic, degrees: usize::saturating_sub(cells, 1) }
}

/// `erfc(x)` with an absolute error below 1.5e-7. Source: M. Abramowitz and I. Stegun, 7.1.26.
fn complementary_error(x: f64) -> f64 {
    let t = 1.0 / (1.0 + 0.327_591_1 * x.abs());
    let polynomial =
        t * (0.254_829_592 + t * (-0.284_496_736 + t * (1.421_413_741 + t * (-1.453_152_027 + t * 1.061_405_429))));
    let tail = polynomial * (-x * x).exp();
    if x >= 0.0 { tail } else { 2.0 - tail }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn probabilities_are_those_of_the_tables() {
        // Quantiles of the distribution: 18.307 (10 degrees, 5 %), 124.342 (100 degrees, 5 %), 135.807 (100 degrees, 1 %).
        for (statistic, degrees, p) in [(18.307, 10, 0.05), (124.342, 100, 0.05), (135.807, 100, 0.01)] {
            let found = ChiSquare { statistic, degrees }.probability();
            assert!((found - p).abs() < 1e-3, "{statistic} {degrees}: {found}");
        }
    }

    #[test]
    fn wrong_densities_are_found() {
        let right = chi_square(&[500, 300, 200], &[0.5, 0.3, 0.2], 1000).probability();
        let wrong = chi_square(&[500, 300, 200], &[0.4, 0.4, 0.2], 1000).probability();
        assert!(right > 0.99 && wrong < 1e-6, "{right} {wrong}");
    }
}
