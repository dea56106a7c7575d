//! Glossy reflection of an environment: prefiltered for each roughness, and combined by the split sum.
//!
//! ```text
//! integral of f L <N.L>  ~  (integral of f L <N.L> / integral of f <N.L>, seen along N)  *  (f0 scale + bias)
//! ```
//!
//! The first factor depends on one direction and the roughness: a cubemap whose mip levels are the roughnesses. The
//! second is [`BrdfTable`].
//!
//! *Sources*: B. Karis, *Real Shading in Unreal Engine 4*, SIGGRAPH 2013 course (the split, and N = V = R); J. Krivanek and
//! M. Colbert, *Real-time Shading with Filtered Importance Sampling*, EGSR 2008 (each sample is looked up in the mip level
//! whose texels are as large as the sample's share of the lobe: a few samples then leave no bright dots).
//! *Departure*: Karis weighs samples with `<N.L>`; here they weigh what the BRDF itself gives them seen along N, so that
//! for a white mirror seen along its normal the split is exact.
//! *Limits*: exact for uniform light. Away from the normal the true lobe is drawn out along the line of sight and leans to
//! the normal; the one here is round, and leans ([`dominant_direction`]) as a metal's does: in soft but many-coloured light
//! a white metal errs by some 10 % of the mean, a dielectric at grazing by 30 to 40 %.

use crate::brdf_table::BrdfTable;
use crate::cubemap::texel_direction;
use crate::face::Face;
use crate::padded::Padded;
use crate::{CubeMips, Cubemap};
use glam::{DVec3, Vec3A, Vec4};
use gonio_light::microfacet::{alpha, distribution, unshadowed_share, visible_facet};
use gonio_light::vector::{reflection, tangent_frame};
use gonio_threads::prelude::*;

/// An environment prefiltered for rough mirrors. Level `i` of `n` is for the roughness `i / (n - 1)`; the first is the
/// environment itself, each next has half its size.
#[derive(Clone, Debug, PartialEq)]
pub struct GlossyMips {
    mips: CubeMips,
}

/// A sample of the lobe, in the local frame with the normal along z.
struct Sample {
    light: Vec3A,
    /// The weight; those of a lobe sum to 1.
    weight: f32,
    /// The mip level of the environment for the lookup.
    level: f32,
}

impl GlossyMips {
    /// A good size of the first level: at roughness 0.2, the second level's, the lobe is 5 degrees wide, and texels of
    /// 128 an edge are 0.7.
    pub const SIZE: u32 = 256;

    /// No level is smaller: at roughness 1 the light varies as slowly as under a cosine lobe, and 8 texels to 90 degrees
    /// with linear filtering show it without a visible edge; 4 would not.
    pub const SIZE_MIN: u32 = 8;

    /// Smaller first levels are enlarged to this, so that there are roughnesses enough: 64, 32, 16, 8.
    const FIRST_MIN: u32 = 64;

    /// The number of directions that a texel of a level gathers. Most lobes of the largest blurred level are narrow, and its texels
    /// many; about wide lobes a sun needs a thousand for its highlight to be smooth to 2 %.
    fn samples(size: u32) -> u32 {
        (SAMPLES_A_FACE / (size * size)).clamp(128, 1024)
    }

    /// Prefilters an environment with its mip levels; the first level is the largest of these of at most `size` texels an edge
    /// (see [`Self::SIZE`]). Uses all threads; the result does not depend on how many.
    pub fn new(environment: &CubeMips, size: u32) -> Self {
        let size = size.max(Self::FIRST_MIN);
        let first = environment.levels().iter().find(|l| l.size() <= size).unwrap_or(environment.full());
        let first = if first.size() < Self::FIRST_MIN {
            Cubemap::from_function(Self::FIRST_MIN, |d| first.sample(d))
        } else {
            first.clone()
        };
        let sizes: Vec<u32> =
            std::iter::successors(Some(first.size()), |s| Some(s / 2)).take_while(|s| *s >= Self::SIZE_MIN).collect();
        let sources: Vec<Padded> = environment.levels().iter().map(Padded::new).collect();
        let last = (sizes.len() - 1).max(1) as f64;
        let mut levels = vec![first];
        for (index, size) in sizes.into_iter().enumerate().skip(1) {
            let samples = lobe(index as f64 / last, environment.full().size(), sources.len(), Self::samples(size));
            levels.push(gathered(size, &sources, &samples));
        }
        GlossyMips { mips: CubeMips::from_levels(levels) }
    }

    /// Returns the levels, smooth first.
    pub fn levels(&self) -> &[Cubemap] {
        self.mips.levels()
    }

    /// Returns the level for a roughness, clamped to `[0, 1]`: the argument of `textureLod` in a shader.
    pub fn level_of_roughness(&self, roughness: f64) -> f64 {
        let held = if roughness > 0.0 { roughness.min(1.0) } else { 0.0 };
        held * (self.levels().len() - 1) as f64
    }

    /// Returns the linear radiance about a direction (any length), averaged over the lobe of a roughness.
    pub fn sample(&self, direction: DVec3, roughness: f64) -> DVec3 {
        self.mips.sample(direction, self.level_of_roughness(roughness))
    }

    /// Returns the light that a rough mirror with unit normal `n` reflects towards unit `v` (both in the world), by the split sum: an
    /// approximation of [`specular_integral`](gonio_light::microfacet::specular_integral). `f0` is the reflectance at
    /// normal incidence. Seen from below (`n.v <= 0`) it is 0.
    pub fn reflected(&self, n: DVec3, v: DVec3, f0: DVec3, roughness: f64) -> DVec3 {
        let cos_v = n.dot(v);
        if cos_v.is_nan() || cos_v <= 0.0 {
            return DVec3::ZERO;
        }
        let (scale, bias) = BrdfTable::get().lookup(cos_v, roughness);
        self.sample(dominant_direction(n, v, roughness), roughness) * (scale * f0 + bias)
    }
}

/// Returns the middle of a rough mirror's lobe, for unit `n` and `v` (not of unit length): the mirror direction for a smooth
/// one, towards the normal for a rough one, whose light from near the horizon is shadowed. Source: S. Lagarde and C. de
/// Rousiers, *Moving Frostbite to Physically Based Rendering*, SIGGRAPH 2014 course, listing 22.
pub fn dominant_direction(n: DVec3, v: DVec3, roughness: f64) -> DVec3 {
    let smooth = 1.0 - alpha(roughness);
    n.lerp(reflection(n, v), smooth * (smooth.sqrt() + alpha(roughness)))
}

/// The number of directions that the texels of one face of a level gather together.
const SAMPLES_A_FACE: u32 = 3 << 19;

/// The golden section.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// The directions to gather for a roughness, in an environment of `size` texels an edge with `levels` mip levels.
fn lobe(roughness: f64, size: u32, levels: usize, count: u32) -> Vec<Sample> {
    let alpha = alpha(roughness);
    // A texel's mean solid angle.
    let texel = 4.0 * std::f64::consts::PI / (6.0 * f64::from(size) * f64::from(size));
    let mut samples: Vec<Sample> = (0..count)
        .filter_map(|index| {
            // A spiral by the golden angle: every sample's share of the disc is nearly as wide as it is long, and so like the
            // texel that stands for it.
            let (u, v) = ((f64::from(index) + 0.5) / f64::from(count), f64::from(index) * GOLDEN % 1.0);
            let h = visible_facet(DVec3::Z, alpha, u, v);
            let part = 1.0 / f64::from(count);
            let light = (2.0 * h.z * h - DVec3::Z).normalize();
            let weight = part * unshadowed_share(1.0, light.z, alpha);
            // Seen along the normal, V.H = N.H: the density of lights is D <N.H> / (4 V.H).
            let share = part / (0.25 * distribution(h.z, alpha));
            // Half a level more than equal areas (Krivanek and Colbert, section 3.2, take a whole one): a level's texels are
            // squares, the samples' shares are not, and what lies between them would be missed.
            let level = (0.5 * (share / texel).log2() + 1.0).clamp(0.0, (levels - 1) as f64);
            (weight > 0.0).then(|| Sample { light: light.as_vec3a(), weight: weight as f32, level: level as f32 })
        })
        .collect();
    let sum: f32 = samples.iter().map(|s| s.weight).sum();
    samples.iter_mut().for_each(|s| s.weight /= sum);
    // Ray by ray from the middle outwards: neighbours in the list then mostly lie on one face and near in memory.
    samples.sort_by(|a, b| a.light.y.atan2(a.light.x).total_cmp(&b.light.y.atan2(b.light.x)));
    samples
}

/// Computes a cubemap whose texels gather the samples about their directions.
fn gathered(size: u32, sources: &[Padded], samples: &[Sample]) -> Cubemap {
    let mut map = Cubemap::new(size, [0.0; 4]);
    let width = size as usize;
    map.pixels_mut().par_chunks_exact_mut(width).enumerate().for_each(|(index, row)| {
        let (face, y) = (Face::ALL[index / width], (index % width) as u32);
        for (x, pixel) in row.iter_mut().enumerate() {
            let normal = texel_direction(face, x as u32, y, size).normalize();
            let (t, b) = tangent_frame(normal, DVec3::ZERO);
            let (n, t, b) = (normal.as_vec3a(), t.as_vec3a(), b.as_vec3a());
            let mut sum = Vec4::ZERO;
            for sample in samples {
                let light = sample.light.x * t + sample.light.y * b + sample.light.z * n;
                sum += sample.weight * Padded::sample(sources, light, sample.level);
            }
            *pixel = [sum.x, sum.y, sum.z, 1.0];
        }
    });
    map
}
