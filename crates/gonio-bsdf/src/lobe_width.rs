//! The width of a BRDF's lobe, measured: the density by which a few directions represent the function best.
//!
//! Among GGX lobes of many widths, about the half vector or a leaning axis, and shares of the cosine, the one is chosen with
//! the least second moment of `f <N.L> / p`, which is the variance of a sum over random directions. No model needs to be known:
//! functions and tables from files are measured alike.

use crate::bsdf::{Bsdf, mean};
use crate::sampling::direction;
use gonio_light::DVec3;
use gonio_light::brdf::LOBE_CAP;
use gonio_light::function_light::FunctionLobe;
use gonio_light::vector::reflection;
use std::f64::consts::{FRAC_1_PI, TAU};

/// Directions of a sum: with half as many, mirrors err by up to 15 % in a furnished room, with twice as many by 2 %.
const COUNT: u32 = 64;

/// Directions that all follow the cosine: matte surfaces vary little over a hemisphere.
const MATTE_COUNT: u32 = 32;

/// Directions of a lobe that is long, and so the solid angles of its directions are.
const ANISOTROPIC_COUNT: u32 = 96;

/// Widths of lobes: from 0.3 degrees to wider than a hemisphere, each this many times the one before.
const NARROWEST: f64 = 0.005;
const WIDTHS: i32 = 17;
const WIDTH_RATIO: f64 = 1.4;

/// Sixteenths of the directions that follow the cosine.
const COSINE_SHARES: [u32; 8] = [0, 1, 2, 4, 6, 8, 12, 16];

/// Leanings of round lobes.
const LEANINGS: [f64; 5] = [1.0, 0.7, 0.4, 0.0, -1.0];

/// A round lobe must be this much better than one of half vectors, which follow more functions to grazing angles.
const CLEARLY_BETTER: f64 = 0.95;

/// A direction to the light with its value.
struct Node {
    view: DVec3,
    light: DVec3,
    /// `f <N.L>`, the mean of its channels, in parts of its integral.
    value: f64,
    /// Solid angle.
    weight: f64,
}

/// The lobe that follows a function.
pub fn function_lobe(bsdf: &dyn Bsdf) -> FunctionLobe {
    let nodes = nodes(bsdf);
    let mut best = Candidate { alpha: [1.0; 2], lean: None, cosine: 16, moment: f64::INFINITY };
    for alpha in (0..WIDTHS).map(width) {
        best.replace_by(&nodes, [alpha; 2], None, 1.0);
    }
    if !bsdf.is_isotropic() {
        for axis in [0, 1, 0, 1] {
            let at = best.alpha;
            for alpha in (0..WIDTHS).map(width) {
                let mut changed = at;
                changed[axis] = alpha;
                best.replace_by(&nodes, changed, None, 1.0);
            }
        }
    }
    let by_half_vectors = best.moment;
    for lean in LEANINGS {
        for alpha in (0..WIDTHS).map(width) {
            let factor = if best.lean.is_none() { by_half_vectors * CLEARLY_BETTER / best.moment } else { 1.0 };
            best.replace_by(&nodes, [alpha; 2], Some(lean), factor);
        }
    }
    let count = match best.cosine {
        16 => MATTE_COUNT,
        _ if bsdf.is_isotropic() => COUNT,
        _ => ANISOTROPIC_COUNT,
    };
    let cosine_count = count * best.cosine / 16;
    FunctionLobe { alpha: best.alpha, lean: best.lean, lobe_count: count - cosine_count, cosine_count }
}

fn width(index: i32) -> f64 {
    (NARROWEST * WIDTH_RATIO.powi(index)).min(1.0)
}

struct Candidate {
    alpha: [f64; 2],
    lean: Option<f64>,
    /// Sixteenths.
    cosine: u32,
    moment: f64,
}

impl Candidate {
    /// Takes a lobe with its best share of the cosine if its moment is less than `factor` times the one so far.
    fn replace_by(&mut self, nodes: &[Node], alpha: [f64; 2], lean: Option<f64>, factor: f64) {
        let lobe = FunctionLobe { alpha, lean, lobe_count: 1, cosine_count: 0 };
        let mut moments = [0.0; COSINE_SHARES.len()];
        for node in nodes {
            let (by_lobe, by_cosine) = (lobe.density(node.view, node.light), node.light.z * FRAC_1_PI);
            for (moment, cosine) in moments.iter_mut().zip(COSINE_SHARES) {
                let share = f64::from(cosine) / 16.0;
                *moment += node.value * node.value * node.weight / (share * by_cosine + (1.0 - share) * by_lobe);
            }
        }
        for (moment, cosine) in moments.into_iter().zip(COSINE_SHARES) {
            if moment < factor * self.moment {
                *self = Candidate { alpha, lean, cosine, moment };
            }
        }
    }
}

/// Half vectors whose slopes are spaced evenly in the logarithm, for several views.
fn nodes(bsdf: &dyn Bsdf) -> Vec<Node> {
    const RINGS: i32 = 30;
    const RATIO: f64 = 1.35;
    const STEPS: u32 = 16;
    let azimuths: &[f64] = if bsdf.is_isotropic() { &[0.0] } else { &[0.0, 0.25, 0.125] };
    let views = [0.15, 0.8, 1.2].into_iter().flat_map(|theta| azimuths.iter().map(move |&turn| (theta, turn)));
    let mut all = Vec::new();
    for view in views.map(|(theta, turn)| direction(theta, TAU * turn)) {
        let mut nodes: Vec<Node> = Vec::new();
        for ring in 0..RINGS {
            let slope = 0.003 * RATIO.powi(ring);
            let cos = 1.0 / (1.0 + slope * slope).sqrt();
            for step in 0..STEPS {
                let phi = TAU * (f64::from(step) + 0.5 * f64::from(ring % 2)) / f64::from(STEPS);
                let half = cos * DVec3::new(slope * phi.cos(), slope * phi.sin(), 1.0);
                let light = reflection(half, view);
                // d(half) = slope d(slope) d(phi) cos^3, and d(light) = 4 (V.H) d(half).
                let of_half = slope * slope * RATIO.ln() * TAU / f64::from(STEPS) * cos.powi(3);
                if half.dot(view) > 0.0 && light.z > 0.0 {
                    nodes.push(Node { view, light, value: 0.0, weight: 4.0 * half.dot(view) * of_half });
                }
            }
        }
        let pairs: Vec<_> = nodes.iter().map(|node| (node.light, view)).collect();
        for (node, value) in nodes.iter_mut().zip(bsdf.evaluate_all(&pairs)) {
            let value = mean(value);
            node.value = if value > 0.0 { value.min(LOBE_CAP) * node.light.z } else { 0.0 };
        }
        let integral: f64 = nodes.iter().map(|node| node.value * node.weight).sum();
        if integral > 0.0 {
            nodes.iter_mut().for_each(|node| node.value /= integral);
            all.append(&mut nodes);
        }
    }
    all
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::ModelSpec;

    fn lobe_of(text: &str) -> FunctionLobe {
        function_lobe(ModelSpec::parse(text).unwrap().build().as_ref())
    }

    /// A narrow GGX mirror is sampled by its own slopes, to the spacing of the widths. The tails of wide ones are left to the cosine.
    #[test]
    fn mirrors_of_known_widths() {
        for alpha in [0.02, 0.1] {
            let lobe = lobe_of(&format!("ggx:a=0,f0=1,alpha={alpha}"));
            assert!((lobe.alpha[0] / alpha).ln().abs() < 0.25, "{alpha}: {lobe:?}");
            assert!(lobe.lean.is_none() && lobe.lobe_count > 48, "{alpha}: {lobe:?}");
        }
    }

    #[test]
    fn anisotropic_lobes_have_two_widths() {
        let lobe = lobe_of("ward-anisotropic:a=0,b=0.5,cx=0.05,cy=0.3");
        let ratio = lobe.alpha[1] / lobe.alpha[0];
        assert!(ratio > 3.5 && ratio < 9.0, "{lobe:?}");
    }

    /// Matte surfaces need the cosine alone, and those with a highlight both.
    #[test]
    fn the_diffuse_part_has_its_share() {
        assert_eq!(lobe_of("lambert").lobe_count, 0);
        let both = lobe_of("ward:a=0.5,b=0.3,c=0.1");
        assert!(both.lobe_count >= 16 && both.cosine_count >= 16, "{both:?}");
    }

    /// A function that scatters no light has some lobe.
    #[test]
    fn black_surfaces_are_measured() {
        let lobe = lobe_of("lambert:a=0");
        assert!(lobe.count() > 0 && lobe.alpha[0] > 0.0, "{lobe:?}");
    }
}
