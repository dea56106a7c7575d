//! Random numbers of walks, which need more of them than a pixel's sampler has good dimensions.

use glam::DVec3;
use gonio_bsdf::sampling::SplitMix;
use gonio_trace::Sampler;
use std::f64::consts::TAU;

/// A sequence of its own for the rest of a sample.
pub fn sequence(sampler: &mut Sampler) -> SplitMix {
    let [x, y] = sampler.next_2d().to_array().map(|u| u64::from((u * 16_777_216.0) as u32));
    SplitMix::new((x << 24 | y).wrapping_mul(0xD1B5_4A32_D192_ED03))
}

/// A free path in a medium with extinction 1: exponentially distributed.
pub fn free_path(random: &mut SplitMix) -> f64 {
    -(1.0 - random.next_number()).ln()
}

/// A direction, uniform over the sphere.
pub fn on_sphere(random: &mut SplitMix) -> DVec3 {
    let cos = 1.0 - 2.0 * random.next_number();
    around(DVec3::Y, cos, TAU * random.next_number())
}

/// A direction around a unit normal, its density proportional to the cosine.
pub fn by_cosine(normal: DVec3, random: &mut SplitMix) -> DVec3 {
    around(normal, random.next_number().sqrt(), TAU * random.next_number())
}

/// A direction uniform in a cone around a unit axis, whose half angle has the cosine `least_cos`.
pub fn in_cone(axis: DVec3, least_cos: f64, random: &mut SplitMix) -> DVec3 {
    around(axis, 1.0 - (1.0 - least_cos) * random.next_number(), TAU * random.next_number())
}

/// The unit direction at an angle from a unit axis, turned around it.
pub fn around(axis: DVec3, cos: f64, turn_rad: f64) -> DVec3 {
    let (a, b) = axis.any_orthonormal_pair();
    let sin = (1.0 - cos * cos).max(0.0).sqrt();
    (axis * cos + (a * turn_rad.cos() + b * turn_rad.sin()) * sin).normalize()
}

/// The mean of samples with its standard error.
pub fn mean_of(samples: impl IntoIterator<Item = f64>) -> [f64; 2] {
    let (mut count, mut sum, mut squares) = (0.0, 0.0, 0.0);
    for sample in samples {
        count += 1.0;
        sum += sample;
        squares += sample * sample;
    }
    let mean = sum / count;
    [mean, ((squares / count - mean * mean).max(0.0) / count).sqrt()]
}
