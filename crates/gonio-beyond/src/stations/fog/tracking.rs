//! Free paths and transmittance of media whose extinction changes along a ray, and the phase function.

use crate::random::{around, free_path};
use glam::DVec3;
use gonio_bsdf::sampling::SplitMix;
use std::f64::consts::{PI, TAU};

/// The distance to the next event along a ray, or `None` beyond `reach`: steps with the extinction `majorant`, of which
/// each is an event with the chance `extinction / majorant` (delta tracking). `extinction` must not exceed `majorant`.
///
/// Source: E. R. Woodcock et al., ANL-7050, 1965.
pub fn delta_track(extinction: &impl Fn(f64) -> f64, majorant: f64, reach: f64, random: &mut SplitMix) -> Option<f64> {
    if majorant <= 0.0 {
        return None;
    }
    let mut at = 0.0;
    loop {
        at += free_path(random) / majorant;
        if at >= reach {
            return None;
        }
        if random.next_number() * majorant < extinction(at) {
            return Some(at);
        }
    }
}

/// An estimate of the transmittance up to `reach`: the product of `1 - extinction / majorant` over the same steps (ratio tracking).
///
/// Source: J. Novák, A. Selle and W. Jarosz, *Residual Ratio Tracking for Estimating Attenuation in Participating Media*,
/// SIGGRAPH Asia 2014.
pub fn ratio_track(extinction: &impl Fn(f64) -> f64, majorant: f64, reach: f64, random: &mut SplitMix) -> f64 {
    if majorant <= 0.0 {
        return 1.0;
    }
    let (mut at, mut transmittance) = (0.0, 1.0);
    loop {
        at += free_path(random) / majorant;
        if at >= reach || transmittance <= 0.0 {
            return transmittance;
        }
        transmittance *= 1.0 - extinction(at) / majorant;
    }
}

/// The phase function of Henyey and Greenstein, 1/sr: the density of the cosine between the directions before and after an
/// event. `g`, from -1 to 1 exclusive, is the mean cosine.
///
/// Source: L. G. Henyey and J. L. Greenstein, Astrophysical Journal 93, 1941.
pub fn phase(cos: f64, g: f64) -> f64 {
    (1.0 - g * g) / (4.0 * PI * (1.0 + g * g - 2.0 * g * cos).powf(1.5))
}

/// A direction after an event, by the phase function.
pub fn scatter(direction: DVec3, g: f64, random: &mut SplitMix) -> DVec3 {
    let u = random.next_number();
    let cos = if g.abs() < 1e-3 {
        1.0 - 2.0 * u
    } else {
        let part = (1.0 - g * g) / (1.0 - g + 2.0 * g * u);
        (1.0 + g * g - part * part) / (2.0 * g)
    };
    around(direction, cos.clamp(-1.0, 1.0), TAU * random.next_number())
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::random::mean_of;

    /// Issue 21: transmittance in closed form, by both kinds of tracking.
    #[test]
    fn both_trackings_have_the_transmittance_of_the_integral() {
        let extinction = |s: f64| 1.0 + 0.8 * (TAU * s).sin();
        for reach in [0.3, 1.3, 2.5] {
            let depth = reach + 0.8 * (1.0 - (TAU * reach).cos()) / TAU;
            let mut random = SplitMix::new(3);
            let passed =
                |random: &mut SplitMix| f64::from(u8::from(delta_track(&extinction, 2.0, reach, random).is_none()));
            let [delta, delta_error] = mean_of((0..40_000).map(|_| passed(&mut random)));
            let [ratio, ratio_error] = mean_of((0..40_000).map(|_| ratio_track(&extinction, 2.0, reach, &mut random)));
            let expected = (-depth).exp();
            assert!((delta - expected).abs() < 4.0 * delta_error, "{reach}: {delta} {expected}");
            assert!((ratio - expected).abs() < 4.0 * ratio_error, "{reach}: {ratio} {expected}");
            assert!(ratio_error < delta_error);
        }
    }

    #[test]
    fn directions_follow_the_phase_function() {
        for g in [-0.7, 0.0, 0.5, 0.9] {
            let mut random = SplitMix::new(4);
            let cosines: Vec<f64> = (0..40_000).map(|_| scatter(DVec3::X, g, &mut random).x).collect();
            let [mean, error] = mean_of(cosines.iter().copied());
            assert!((mean - g).abs() < 4.0 * error, "{g}: {mean}");
            let steps = 20_000;
            let cos = |i: u32| -1.0 + 2.0 * (f64::from(i) + 0.5) / f64::from(steps);
            let total: f64 = (0..steps).map(|i| TAU * phase(cos(i), g) * 2.0 / f64::from(steps)).sum();
            assert!((total - 1.0).abs() < 1e-4, "{g}: {total}");
            // The share of directions in the forward half.
            let ahead = mean_of(cosines.iter().map(|cos| f64::from(u8::from(*cos > 0.0))));
            let expected: f64 = (steps / 2..steps).map(|i| TAU * phase(cos(i), g) * 2.0 / f64::from(steps)).sum();
            assert!((ahead[0] - expected).abs() < 4.0 * ahead[1] + 1e-4, "{g}: {ahead:?} {expected}");
        }
    }

    /// Light of a white sky that a layer of height 1 reflects: its extinction is 0.4 in the upper quarter, 3.6 in the lower one,
    /// and linear between.
    fn reflected_by_slab(cosine: f64, random: &mut SplitMix) -> f64 {
        let mut height = 1.0;
        let mut direction = DVec3::new((1.0 - cosine * cosine).sqrt(), 0.0, -cosine);
        let mut light = 1.0;
        loop {
            let up = direction.z;
            let extinction = |s: f64| 3.6 - 3.2 * ((height + up * s - 0.25) / 0.5).clamp(0.0, 1.0);
            let reach = if up > 0.0 { (1.0 - height) / up } else { height / -up };
            let Some(s) = delta_track(&extinction, 3.6, reach, random) else {
                return if up > 0.0 { light } else { 0.0 };
            };
            height += up * s;
            light *= 0.9;
            direction = scatter(direction, 0.6, random);
        }
    }

    /// Issue 21: Mitsuba's volumetric path tracer has the same light within 3 standard errors.
    #[test]
    fn a_layer_of_fog_is_that_of_mitsuba() {
        let reference = include_str!("../../../tests/mitsuba/reference.txt");
        let mut random = SplitMix::new(5);
        let mut count = 0;
        for line in reference.lines().filter_map(|line| line.strip_prefix("slab ")) {
            let numbers: Vec<f64> = line.split(' ').map(|number| number.parse().unwrap()).collect();
            let &[cosine, expected, its_error] = numbers.as_slice() else { panic!("{line}") };
            let [mean, error] = mean_of((0..40_000).map(|_| reflected_by_slab(cosine, &mut random)));
            assert!((mean - expected).abs() < 3.0 * error.hypot(its_error), "{cosine}: {mean} {error}, {expected}");
            count += 1;
        }
        assert_eq!(count, 4);
    }
}
