//! The light that leaves a pawn, remembered at vertices of its surface: neighbouring pixels share their walks.

use super::pawn::{pawn, pawn_normal};
use crate::noise::cell_numbers;
use glam::{DVec2, DVec3, IVec2};
use gonio_bsdf::sampling::SplitMix;
use std::f64::consts::TAU;
use std::sync::{LazyLock, OnceLock};

/// Vertices around the axis, and sets of walks at each vertex.
const AROUND: usize = 128;
/// Sets of walks: the samples of a pixel take all of them in turn.
pub const SETS: usize = 16;
/// The distance between rows of vertices along the outline.
const ROW: f64 = 0.018;

/// The outline from the top to the table: radius and height, `ROW` apart.
static OUTLINE: LazyLock<Vec<DVec2>> = LazyLock::new(|| {
    let mut at = DVec2::new(1e-3, 0.99);
    let mut outline = Vec::new();
    while at.y > 0.0 && outline.len() < 1000 {
        for _ in 0..8 {
            let place = DVec3::new(at.x, at.y, 0.0);
            let normal = pawn_normal(place);
            at -= DVec2::new(normal.x, normal.y) * pawn(place);
        }
        outline.push(at);
        let normal = pawn_normal(DVec3::new(at.x, at.y, 0.0));
        at += DVec2::new(normal.y, -normal.x) * ROW;
    }
    outline
});

/// Light at the vertices, as far as it is known.
pub struct SurfaceCache {
    /// For each set nothing until it is needed, then the vertices.
    sets: [OnceLock<Vec<OnceLock<DVec3>>>; SETS],
}

impl SurfaceCache {
    /// Nothing is known.
    pub fn new() -> Self {
        Self { sets: std::array::from_fn(|_| OnceLock::new()) }
    }

    /// The light at a place of the surface, by set `set` of walks. A vertex near the place is drawn: the mean is a smooth spline over
    /// the vertices. `find` finds the light at a vertex, with numbers that belong to it.
    pub fn light(
        &self,
        at: DVec3,
        set: usize,
        random: &mut SplitMix,
        find: impl FnOnce(DVec3, &mut SplitMix) -> DVec3,
    ) -> DVec3 {
        let place = DVec2::new(DVec2::new(at.x, at.z).length(), at.y);
        let nearest = (0..OUTLINE.len())
            .min_by(|a, b| OUTLINE[*a].distance_squared(place).total_cmp(&OUTLINE[*b].distance_squared(place)))
            .unwrap_or(0);
        // The position between rows, along the outline.
        let (before, after) = (OUTLINE[nearest.saturating_sub(1)], OUTLINE[(nearest + 1).min(OUTLINE.len() - 1)]);
        let along = (after - before).normalize_or_zero().dot(place - OUTLINE[nearest]) / ROW;
        // Offsets with the density of a quadratic B-spline, at most 1.5.
        let mut offset = || random.next_number() + random.next_number() + random.next_number() - 1.5;
        let row = (nearest as f64 + along + offset()).round().clamp(0.0, (OUTLINE.len() - 1) as f64) as usize;
        // Fewer vertices where the body is thin, so that they are about as far apart everywhere.
        let turns = ((TAU * OUTLINE[row].x / ROW) as usize).clamp(6, AROUND);
        let turn = (at.z.atan2(at.x) / TAU * turns as f64 + offset()).round() as i64;
        let turn = turn.rem_euclid(turns as i64) as usize;
        let (vertex, set) = (row * AROUND + turn, set.min(SETS - 1));
        let count = OUTLINE.len() * AROUND;
        let light = self.sets[set].get_or_init(|| std::iter::repeat_with(OnceLock::new).take(count).collect());
        *light[vertex].get_or_init(|| {
            let angle = turn as f64 / turns as f64 * TAU;
            let DVec2 { x, y } = OUTLINE[row];
            let seed =
                cell_numbers(IVec2::new((vertex * SETS + set) as i32, 3), 77).map(|number| (number * 256.0) as u8);
            find(DVec3::new(x * angle.cos(), y, x * angle.sin()), &mut SplitMix::new(u64::from_le_bytes(seed)))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_outline_lies_on_the_surface_from_top_to_table() {
        assert!(OUTLINE.len() > 60, "{}", OUTLINE.len());
        for pair in OUTLINE.windows(2) {
            assert!(pawn(DVec3::new(pair[0].x, pair[0].y, 0.0)).abs() < 1e-3, "{}", pair[0]);
            let step = pair[0].distance(pair[1]);
            assert!(step > 0.4 * ROW && step < 1.3 * ROW, "{step} at {}", pair[0]);
        }
        assert!(OUTLINE.last().is_some_and(|last| last.y < 2.0 * ROW));
    }

    /// The mean over samples is a smooth function of the place that has the values of a linear one.
    #[test]
    fn samples_of_a_linear_function_have_its_mean() {
        let cache = SurfaceCache::new();
        let at = DVec3::new(0.165 * 0.6, 0.825, 0.165 * 0.8);
        let mut random = SplitMix::new(1);
        let sum: DVec3 = (0..4000).map(|i| cache.light(at, i % SETS, &mut random, |vertex, _| vertex)).sum();
        assert!((sum / 4000.0 - at).length() < 0.004, "{} {at}", sum / 4000.0);
    }
}
