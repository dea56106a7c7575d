//! Integrals of a BSDF over directions.

use crate::bsdf::Bsdf;
use crate::sampling::{direction, direction_of_cosine};
use gonio_light::DVec3;
use gonio_light::microfacet::hammersley;
use std::f64::consts::{FRAC_PI_2, TAU};

/// Steps of the polar angle in the quadrature of [`directional_albedo`]: half a degree each.
const POLAR_STEPS: u32 = 180;

/// The share of light from `w` that a surface scatters, per channel: the integral of `f(w, x) |cos theta_x|` over all `x`.
///
/// By importance sampling where the samples follow the function, with a relative error of about 0.2 %; otherwise by steps of
/// half a degree, which resolve lobes of a degree. NaN if the function is not finite.
pub fn directional_albedo(bsdf: &dyn Bsdf, w: DVec3) -> DVec3 {
    albedo_with_steps(bsdf, w, POLAR_STEPS)
}

/// [`directional_albedo`] by this number of steps of the polar angle, or its square of samples. Fewer are quicker and less
/// exact.
pub fn albedo_with_steps(bsdf: &dyn Bsdf, w: DVec3, steps: u32) -> DVec3 {
    let steps = steps.clamp(2, 1000);
    if bsdf.samples_follow_function() { sampled_albedo(bsdf, w, steps * steps) } else { stepped_albedo(bsdf, w, steps) }
}

fn sampled_albedo(bsdf: &dyn Bsdf, w: DVec3, samples: u32) -> DVec3 {
    // The samples are those of light for a viewer at `w`; reversed, radiance changes with the squares of the indices.
    let index = bsdf.index(w);
    let mut sum = DVec3::ZERO;
    for i in 0..samples {
        let (u, v) = hammersley(i, samples);
        // A third number that is independent of both: the golden ratio's sequence.
        let third = (f64::from(i) * 0.618_033_988_749_894_9).fract();
        if let Some(sample) = bsdf.sample(w, [u, v, third]) {
            sum += sample.weight * (bsdf.index(sample.wi) / index).powi(2);
        }
    }
    sum / f64::from(samples)
}

fn stepped_albedo(bsdf: &dyn Bsdf, w: DVec3, steps: u32) -> DVec3 {
    let azimuths = 2 * steps;
    let (step, azimuth_step) = (FRAC_PI_2 / f64::from(steps), TAU / f64::from(azimuths));
    let sides: &[f64] = if bsdf.transmits() { &[1.0, -1.0] } else { &[1.0] };
    let mut sum = DVec3::ZERO;
    for side in sides {
        // All at once: functions that run in the interpreter are much faster so.
        let thetas: Vec<f64> = (0..steps).map(|i| (f64::from(i) + 0.5) * step).collect();
        let pairs: Vec<(DVec3, DVec3)> = thetas
            .iter()
            .flat_map(|theta| (0..azimuths).map(move |j| direction(*theta, (f64::from(j) + 0.5) * azimuth_step)))
            .map(|x| (w, DVec3::new(x.x, x.y, side * x.z)))
            .collect();
        let values = bsdf.evaluate_all(&pairs);
        for (theta, ring) in thetas.iter().zip(values.chunks(azimuths as usize)) {
            let ring_sum: DVec3 = ring.iter().copied().sum();
            sum += ring_sum * (theta.sin() * theta.cos() * step * azimuth_step);
        }
    }
    sum
}

/// The integral of a function over a cell in cosine and azimuth, by the product of three Gauss points each way, with cells
/// halved until the integral changes by less than `tolerance`.
pub fn over_cell(function: &dyn Fn(DVec3) -> f64, cos: [f64; 2], phi: [f64; 2], tolerance: f64) -> f64 {
    // Lobes narrower than a cell are found by points that are close enough together.
    const FIRST: u32 = 4;
    let part = |[from, to]: [f64; 2], i: u32| {
        let at = |i: u32| from + (to - from) * f64::from(i) / f64::from(FIRST);
        [at(i), at(i + 1)]
    };
    let tolerance = tolerance / f64::from(FIRST * FIRST);
    let mut sum = 0.0;
    for i in 0..FIRST {
        for j in 0..FIRST {
            let (cos, phi) = (part(cos, i), part(phi, j));
            sum += refined(function, cos, phi, gauss(function, cos, phi), tolerance, 6);
        }
    }
    sum
}

fn refined(f: &dyn Fn(DVec3) -> f64, cos: [f64; 2], phi: [f64; 2], whole: f64, tolerance: f64, depth: u32) -> f64 {
    let halves = |[from, to]: [f64; 2]| {
        let middle = 0.5 * (from + to);
        [[from, middle], [middle, to]]
    };
    let cells: Vec<_> = halves(cos).into_iter().flat_map(|c| halves(phi).map(|p| (c, p, gauss(f, c, p)))).collect();
    let sum: f64 = cells.iter().map(|cell| cell.2).sum();
    if depth == 0 || (sum - whole).abs() < tolerance {
        return sum;
    }
    cells.into_iter().map(|(c, p, value)| refined(f, c, p, value, 0.5 * tolerance, depth - 1)).sum()
}

fn gauss(f: &dyn Fn(DVec3) -> f64, cos: [f64; 2], phi: [f64; 2]) -> f64 {
    const POINTS: [(f64, f64); 3] = [(-0.774_596_669_241_483_4, 5.0), (0.0, 8.0), (0.774_596_669_241_483_4, 5.0)];
    let at = |[from, to]: [f64; 2], x: f64| 0.5 * ((from + to) + x * (to - from));
    let area = (cos[1] - cos[0]) * (phi[1] - phi[0]) / (18.0 * 18.0);
    let mut sum = 0.0;
    for (x, weight_x) in POINTS {
        for (y, weight_y) in POINTS {
            sum += weight_x * weight_y * f(direction_of_cosine(at(cos, x), at(phi, y)));
        }
    }
    sum * area
}
