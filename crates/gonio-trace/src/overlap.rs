//! Light sources in the same place as other surfaces.
//!
//! Of surfaces in one place a ray meets the one that rounding makes the nearest, and a sample of a light would find each of
//! them. So that light counts once:
//!
//! | in the same place | rule |
//! |---|---|
//! | a lamp and a surface | the lamp covers the surface on the side where it shines |
//! | two lamps | the first covers the second |
//! | a triangle that emits light, and a surface | only samples of lights find the triangle's light: all of it |
//! | two triangles that emit light | the same, where a ray meets the sampled one |

use crate::geometry::Geometry;
use crate::lamps::Lamp;
use crate::lights::{LightSample, LightSource, Lights, Strength};
use crate::tree::Ray;
use glam::{Vec2, Vec3};
use std::collections::BTreeSet;

/// Triangles that emit light of which overlaps are looked for, at most; of more, so many of them.
const MOST_TESTED: usize = 1 << 14;

/// Places on a triangle at which something else is looked for.
const WEIGHTS: [Vec3; 4] =
    [Vec3::new(0.34, 0.33, 0.33), Vec3::new(0.1, 0.2, 0.7), Vec3::new(0.7, 0.1, 0.2), Vec3::new(0.2, 0.7, 0.1)];

/// Triangles that emit light and lie in the same place as others, and these others; in ascending order.
pub(crate) fn overlapping_triangles(geometry: &Geometry, sources: &[LightSource]) -> Vec<u32> {
    let emitting = |source: &LightSource| match source {
        LightSource::Triangle { triangle, .. } => Some(*triangle),
        _ => None,
    };
    let triangles: Vec<u32> = sources.iter().filter_map(emitting).collect();
    let mut found = BTreeSet::new();
    for &triangle in triangles.iter().step_by(triangles.len().div_ceil(MOST_TESTED).max(1)) {
        let normal = geometry.geometric_normal(triangle);
        for weights in WEIGHTS {
            let (point, error) = geometry.point(triangle, weights);
            // Whether triangles as small as the rounding error overlap cannot be told.
            if geometry.area(triangle).sqrt() < 64.0 * error {
                break;
            }
            let step = 4.0 * error;
            for side in [normal, -normal] {
                let ray = Ray { origin: point + side * step, direction: -side, reach: 2.0 * step };
                let other = geometry.tree.nearest(&ray).map(|hit| hit.triangle).filter(|other| *other != triangle);
                if let Some(other) = other
                    && geometry.geometric_normal(other).dot(normal).abs() > 0.999
                {
                    found.extend([triangle, other]);
                }
            }
        }
    }
    found.into_iter().collect()
}

impl Lights {
    /// Whether a triangle is in the same place as another one, and one of them emits light.
    #[inline]
    pub fn overlaps(&self, triangle: u32) -> bool {
        !self.overlapping.is_empty() && self.overlapping.binary_search(&triangle).is_ok()
    }

    /// Whether another triangle that emits light hides the one that was sampled. `ray`: from where nothing else is between
    /// them, to the light.
    pub fn is_covered(&self, geometry: &Geometry, ray: &Ray, sample: &LightSample) -> bool {
        let Strength::Emitted(triangle, _) = sample.light else { return false };
        if !self.overlaps(triangle) {
            return false;
        }
        let met = geometry.tree.nearest(&Ray { reach: f32::INFINITY, ..*ray }).map(|hit| hit.triangle);
        met.is_some_and(|met| met != triangle && geometry.triangles[met as usize].light.is_some() && self.overlaps(met))
    }

    /// The nearest lamp that a ray meets before a surface at its end: its index, the distance, and whether where it shines.
    pub fn nearest_lamp(&self, ray: &Ray) -> Option<(usize, f32, bool)> {
        let mut nearest = None;
        let mut reach = ray.reach;
        for (index, (lamp, _)) in self.lamps.iter().enumerate() {
            let Some((distance, shines)) = lamp.shape.hit(&Ray { reach: f32::INFINITY, ..*ray }) else { continue };
            let slack = lamp.shape.rounding(ray.direction, distance);
            if distance < if nearest.is_none() && shines { reach + slack } else { reach - slack } {
                reach = distance.min(reach);
                nearest = Some((index, distance, shines));
            }
        }
        nearest
    }

    /// Whether a lamp other than that of a sample is in the way to it.
    pub fn lamps_block(&self, ray: &Ray, sample: &LightSample) -> bool {
        let is_surface = !matches!(sample.light, Strength::Irradiance(..));
        self.lamps.iter().filter(|(_, source)| *source != sample.source).any(|(lamp, source)| {
            let Some((distance, shines)) = lamp.shape.hit(&Ray { reach: f32::INFINITY, ..*ray }) else { return false };
            let slack = lamp.shape.rounding(ray.direction, distance);
            let covers = shines && is_surface && *source < sample.source;
            // The ray ends before the sampled surface, by the slack at most.
            distance < if covers { ray.reach + 2.5 * slack } else { ray.reach - slack }
        })
    }

    /// Pairs of lamps in the same place, by their sources: the first covers a part of the second.
    pub fn overlapping_lamps(&self) -> Vec<(usize, usize)> {
        let mut pairs = Vec::new();
        for (second, (lamp, source)) in self.lamps.iter().enumerate() {
            let covering = self.lamps[..second].iter().find(|(first, _)| covers(first, lamp));
            pairs.extend(covering.map(|(_, first)| (*first, *source)));
        }
        pairs
    }
}

/// Whether `first` is where some places of `second` are.
fn covers(first: &Lamp, second: &Lamp) -> bool {
    [[0.5, 0.5], [0.1, 0.2], [0.8, 0.3], [0.3, 0.9], [0.9, 0.7]].into_iter().any(|u| {
        let (origin, direction) = second.shape.looked_at(Vec2::from(u));
        let ray = Ray { origin, direction, reach: f32::INFINITY };
        let (Some((a, true)), Some((b, true))) = (first.shape.hit(&ray), second.shape.hit(&ray)) else { return false };
        (a - b).abs() <= first.shape.rounding(direction, a)
    })
}
