//! The samples of each texel of an atlas, and what lies between the charts.

use glam::{DVec2, DVec3, DVec4};
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Rows that are baked together: few, as a traced row takes long, and progress is told between bands.
const BAND: usize = 4;

/// Samples between which a stop is noticed: each may trace thousands of rays.
const SAMPLES_BETWEEN: u32 = 256;

/// A point of a surface, as a texel sees it.
#[derive(Clone, Copy, Debug)]
pub struct TexelSample {
    /// Triangle of the mesh.
    pub triangle: usize,
    /// Barycentric coordinates.
    pub weights: DVec3,
    /// Change of the weights to the next sample on the right, and to the one above.
    pub steps: [DVec3; 2],
    /// A number of its own for each sample of the atlas, for random directions.
    pub seed: u32,
}

/// A square of texels, first row at the **bottom** (v = 0).
#[derive(Clone, Debug)]
pub struct BakedTexels {
    /// Texels along a side.
    pub size: u32,
    /// `size * size` values: three channels, and the variance of the noise in them.
    pub values: Vec<[f32; 4]>,
    /// Whether the value is that of a triangle, not of the background.
    pub covered: Vec<bool>,
}

/// The value of a texel that a triangle touches, but whose centre no triangle covers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Border {
    /// That at the point of a triangle nearest to the centre.
    Nearest,
    /// That at the centre, in the plane of the nearest triangle: for functions that have a value beyond it, such as textures. A
    /// bilinear lookup at the edge of a chart then reads a smooth function. It reads texels up to one texel away, so these count too.
    Continued,
}

impl Border {
    /// How far from a triangle, in texels along either axis, the centres of its texels lie at most.
    fn reach(self) -> f64 {
        match self {
            Border::Nearest => 0.5,
            Border::Continued => 1.0,
        }
    }
}

/// Weights beyond this are not continued: the triangle is a sliver, and its plane tells nothing about its surroundings.
const MOST_CONTINUED: f64 = -1.0;

/// Bakes `evaluate` (three channels, and the variance of the noise in them, independent for each sample) into a square of `size` x
/// `size` texels: the mean over a grid of `grid` x `grid` samples of those on a
/// triangle; for a texel that a triangle touches without covering a sample, what `border` says.
///
/// `tex_coords` has three for each triangle; triangles for which `is_used` is false are left out, and so are texels
/// outside of the square. `go_on` gets the share done, from any thread; `None` if it returned false.
pub fn bake_texels(
    tex_coords: &[[f32; 2]],
    is_used: impl Fn(usize) -> bool + Sync,
    size: u32,
    grid: u32,
    border: Border,
    evaluate: impl Fn(&TexelSample) -> DVec4 + Sync,
    go_on: &(dyn Fn(f64) -> bool + Sync),
) -> Option<BakedTexels> {
    let side = size as usize;
    let triangles: Vec<TexelTriangle> = (0..tex_coords.len() / 3)
        .filter(|&t| is_used(t))
        .filter_map(|t| TexelTriangle::new(t, [0, 1, 2].map(|k| tex_coords[3 * t + k]), size, grid, border))
        .collect();
    let bands = side.div_ceil(BAND);
    let mut in_band: Vec<Vec<u32>> = vec![Vec::new(); bands];
    for (index, triangle) in triangles.iter().enumerate() {
        for band in &mut in_band[triangle.low[1] / BAND..=triangle.high[1] / BAND] {
            band.push(index as u32);
        }
    }
    let done = AtomicUsize::new(0);
    let mut values = vec![[0.0; 4]; side * side];
    let mut covered = vec![false; side * side];
    // Each band writes to its own rows, so that sums exist for the bands at work only.
    let rows = values.par_chunks_mut(BAND * side).zip(covered.par_chunks_mut(BAND * side));
    let is_done = rows.zip(&in_band).enumerate().all(|(number, ((values, covered), members))| {
        let rows = BAND * number..(BAND * (number + 1)).min(side);
        let mut band = Band::new(rows, side, grid);
        let members = || members.iter().map(|&index| &triangles[index as usize]);
        let keep_on = || go_on(done.load(Ordering::Relaxed) as f64 / bands as f64);
        let is_whole = members().all(|triangle| band.add_samples(triangle, &evaluate, &keep_on))
            && band.finish(members(), border, &evaluate, &keep_on);
        if !is_whole {
            return false;
        }
        for (value, sum) in values.iter_mut().zip(&band.sums) {
            *value = sum.as_vec4().to_array();
        }
        for (covered, count) in covered.iter_mut().zip(&band.counts) {
            *covered = *count > 0;
        }
        let done = 1 + done.fetch_add(1, Ordering::Relaxed);
        go_on(done as f64 / bands as f64)
    });
    is_done.then_some(BakedTexels { size, values, covered })
}

/// A triangle in texels.
struct TexelTriangle {
    triangle: usize,
    corners: [DVec2; 3],
    /// Weights at a point: `origin + x * steps[0] + y * steps[1]`.
    origin: DVec3,
    per_texel: [DVec3; 2],
    steps: [DVec3; 2],
    /// The texels that it may touch.
    low: [usize; 2],
    high: [usize; 2],
}

impl TexelTriangle {
    /// `None` without an area in the texture, or outside of it.
    fn new(triangle: usize, tex_coords: [[f32; 2]; 3], size: u32, grid: u32, border: Border) -> Option<Self> {
        let corners = tex_coords.map(|uv| DVec2::from(uv.map(f64::from)) * f64::from(size));
        let [a, b, c] = corners;
        let area = (b - a).perp_dot(c - a);
        if !area.is_finite() || area == 0.0 {
            return None;
        }
        // The gradient of a corner's weight is the opposite edge, turned, by twice the area.
        let along_x = DVec3::new(b.y - c.y, c.y - a.y, a.y - b.y) / area;
        let along_y = DVec3::new(c.x - b.x, a.x - c.x, b.x - a.x) / area;
        let origin = DVec3::X - a.x * along_x - a.y * along_y;
        let most = f64::from(size) - 1.0;
        let beyond = border.reach() - 0.5;
        let low = (a.min(b).min(c) - beyond).floor();
        let high = (a.max(b).max(c) + beyond).floor();
        if low.max_element() > most || high.min_element() < 0.0 || !origin.is_finite() {
            return None;
        }
        let held = |v: DVec2| v.clamp(DVec2::ZERO, DVec2::splat(most)).to_array().map(|c| c as usize);
        let per_texel = [along_x, along_y];
        let steps = per_texel.map(|step| step / f64::from(grid));
        Some(TexelTriangle { triangle, corners, origin, per_texel, steps, low: held(low), high: held(high) })
    }

    fn weights(&self, p: DVec2) -> DVec3 {
        self.origin + p.x * self.per_texel[0] + p.y * self.per_texel[1]
    }

    /// The point of the triangle that is nearest to a point outside of it.
    fn nearest(&self, p: DVec2) -> DVec2 {
        let on_edge = |k: usize| {
            let (a, b) = (self.corners[k], self.corners[(k + 1) % 3]);
            let along = ((p - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
            if along.is_finite() { a + along * (b - a) } else { a }
        };
        let points = [0, 1, 2].map(on_edge);
        points.into_iter().min_by(|a, b| a.distance_squared(p).total_cmp(&b.distance_squared(p))).unwrap_or(p)
    }
}

/// Some rows while they are baked.
struct Band {
    rows: std::ops::Range<usize>,
    side: usize,
    grid: u32,
    sums: Vec<DVec4>,
    counts: Vec<u32>,
    /// Samples since a stop was last looked for.
    unheard: u32,
}

impl Band {
    fn new(rows: std::ops::Range<usize>, side: usize, grid: u32) -> Self {
        let count = rows.len() * side;
        Band { rows, side, grid, sums: vec![DVec4::ZERO; count], counts: vec![0; count], unheard: 0 }
    }

    /// Counts a sample; returns whether to go on.
    fn goes_on(&mut self, keep_on: &dyn Fn() -> bool) -> bool {
        self.unheard += 1;
        if self.unheard < SAMPLES_BETWEEN {
            return true;
        }
        self.unheard = 0;
        keep_on()
    }

    /// The texels of this band that a triangle may touch: column, row, index.
    fn texels(&self, triangle: &TexelTriangle) -> impl Iterator<Item = (usize, usize, usize)> + use<> {
        let (first, side) = (self.rows.start, self.side);
        let columns = triangle.low[0]..=triangle.high[0];
        let rows = triangle.low[1].max(first)..=triangle.high[1].min(self.rows.end - 1);
        rows.flat_map(move |y| columns.clone().map(move |x| (x, y, (y - first) * side + x)))
    }

    /// Returns whether to go on.
    fn add_samples(
        &mut self,
        triangle: &TexelTriangle,
        evaluate: &impl Fn(&TexelSample) -> DVec4,
        keep_on: &dyn Fn() -> bool,
    ) -> bool {
        let grid = self.grid;
        for (x, y, index) in self.texels(triangle) {
            for (row, column) in (0..grid).flat_map(|row| (0..grid).map(move |column| (row, column))) {
                let offset = (DVec2::new(column.into(), row.into()) + 0.5) / f64::from(grid);
                let weights = triangle.weights(DVec2::new(x as f64, y as f64) + offset);
                if weights.min_element() >= 0.0 {
                    let seed = ((y * self.side + x) as u32).wrapping_mul(grid * grid).wrapping_add(row * grid + column);
                    let sample = TexelSample { triangle: triangle.triangle, weights, steps: triangle.steps, seed };
                    self.sums[index] += evaluate(&sample);
                    self.counts[index] += 1;
                    if !self.goes_on(keep_on) {
                        return false;
                    }
                }
            }
        }
        true
    }

    /// Divides the sums, and fills texels that are touched only. Returns whether to go on.
    fn finish<'t>(
        &mut self,
        triangles: impl Iterator<Item = &'t TexelTriangle>,
        border: Border,
        evaluate: &impl Fn(&TexelSample) -> DVec4,
        keep_on: &dyn Fn() -> bool,
    ) -> bool {
        let mut nearest: Vec<Option<(f64, TexelSample)>> = vec![None; self.sums.len()];
        for triangle in triangles {
            for (x, y, index) in self.texels(triangle) {
                if self.counts[index] > 0 {
                    continue;
                }
                let center = DVec2::new(x as f64 + 0.5, y as f64 + 0.5);
                let point = triangle.nearest(center);
                let distance = point.distance_squared(center);
                let touches = (point - center).abs().max_element() <= border.reach();
                if touches && nearest[index].is_none_or(|(least, _)| distance < least) {
                    let continued = Some(triangle.weights(center))
                        .filter(|weights| border == Border::Continued && weights.min_element() >= MOST_CONTINUED);
                    let weights = continued.unwrap_or_else(|| {
                        let weights = triangle.weights(point).max(DVec3::ZERO);
                        weights / weights.element_sum()
                    });
                    let seed = (y * self.side + x) as u32;
                    let sample = TexelSample { triangle: triangle.triangle, weights, steps: triangle.steps, seed };
                    nearest[index] = Some((distance, sample));
                }
            }
        }
        for (index, nearest) in nearest.into_iter().enumerate() {
            if let Some((_, sample)) = nearest {
                (self.sums[index], self.counts[index]) = (evaluate(&sample), 1);
                if !self.goes_on(keep_on) {
                    return false;
                }
            } else if self.counts[index] > 0 {
                let count = f64::from(self.counts[index]);
                self.sums[index] /= DVec4::new(count, count, count, count * count);
            }
        }
        true
    }
}

impl BakedTexels {
    /// Gives every texel that no triangle touches the value of the nearest one that a triangle touches. A lookup
    /// between texels, or in a smaller level, near a chart then reads colours of that chart only, never a background.
    ///
    /// The nearest texels are exact: the distances along columns, then the lower envelope of parabolas along rows
    /// (P. F. Felzenszwalb, D. P. Huttenlocher, "Distance transforms of sampled functions", 2012).
    pub fn fill_background(&mut self) {
        if !self.covered.contains(&true) {
            return;
        }
        let side = self.size as usize;
        let row_of = self.nearest_rows();
        let mut nearest = vec![0; side * side];
        nearest.par_chunks_mut(side).enumerate().for_each(|(y, row)| nearest_in_row(y, side, &row_of, row));
        drop(row_of);
        // Covered texels are their own nearest ones, so no value that is still read has changed.
        for (index, nearest) in nearest.into_iter().enumerate().filter(|(index, _)| !self.covered[*index]) {
            self.values[index] = self.values[nearest as usize];
        }
    }

    /// For each texel the row of the nearest covered texel of its column; `u32::MAX` where the column has none.
    fn nearest_rows(&self) -> Vec<u32> {
        let side = self.size as usize;
        let mut rows = vec![u32::MAX; side * side];
        let pass = |rows: &mut Vec<u32>, order: &mut dyn Iterator<Item = usize>| {
            let mut last = vec![u32::MAX; side];
            for y in order {
                for (x, last) in last.iter_mut().enumerate() {
                    let index = y * side + x;
                    if self.covered[index] {
                        *last = y as u32;
                    }
                    let distance = |row: u32| if row == u32::MAX { u32::MAX } else { row.abs_diff(y as u32) };
                    if distance(*last) < distance(rows[index]) {
                        rows[index] = *last;
                    }
                }
            }
        };
        pass(&mut rows, &mut (0..side));
        pass(&mut rows, &mut (0..side).rev());
        rows
    }

    /// The texels with their first row at the top, as image files have them.
    pub fn rows_from_top(&self) -> impl Iterator<Item = [f32; 4]> + '_ {
        self.values.chunks(self.size.max(1) as usize).rev().flatten().copied()
    }
}

/// Finds the index of the nearest covered texel for each texel of row `y`.
fn nearest_in_row(y: usize, side: usize, row_of: &[u32], nearest: &mut [u32]) {
    let row = &row_of[y * side..][..side];
    let height = |x: usize| (f64::from(row[x]) - y as f64).powi(2);
    // Parabolas of the envelope: their column, and where each begins.
    let mut envelope: Vec<(usize, f64)> = Vec::new();
    for x in (0..side).filter(|&x| row[x] != u32::MAX) {
        let mut start = f64::NEG_INFINITY;
        while let Some(&(other, other_start)) = envelope.last() {
            let (a, b) = (other as f64, x as f64);
            start = ((height(x) + b * b) - (height(other) + a * a)) / (2.0 * (b - a));
            if start > other_start {
                break;
            }
            envelope.pop();
            start = f64::NEG_INFINITY;
        }
        envelope.push((x, start));
    }
    let mut current = 0;
    let mut index = |x: usize| {
        while envelope.get(current + 1).is_some_and(|(_, start)| *start < x as f64) {
            current += 1;
        }
        let column = envelope.get(current).map_or(x, |(column, _)| *column);
        row[column].saturating_mul(side as u32).saturating_add(column as u32)
    };
    for (x, nearest) in nearest.iter_mut().enumerate() {
        *nearest = index(x);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against the plain definition, on a pattern without order.
    #[test]
    fn the_background_continues_the_nearest_texel() {
        let size = 37_u32;
        let is_covered = |i: u32| (i.wrapping_mul(2_654_435_761) >> 24) < 4;
        let covered: Vec<bool> = (0..size * size).map(is_covered).collect();
        let values = (0..size * size).map(|i| [i as f32, 0.0, 0.0, 1.0]).collect();
        let mut texels = BakedTexels { size, values, covered: covered.clone() };
        texels.fill_background();
        let place = |i: u32| ((i % size) as i64, (i / size) as i64);
        let distance = |i: u32, j: u32| {
            let ((x, y), (u, v)) = (place(i), place(j));
            (x - u).pow(2) + (y - v).pow(2)
        };
        for i in 0..size * size {
            let least = (0..size * size).filter(|&j| covered[j as usize]).map(|j| distance(i, j)).min();
            let found = texels.values[i as usize][0] as u32;
            assert!(covered[found as usize] && Some(distance(i, found)) == least, "texel {i}: {found}");
        }
    }

    /// A linear function is its value at the mean of the samples; at texels that are wholly covered, at the centre.
    #[test]
    fn a_linear_function_is_baked_exactly() {
        let tex_coords = [[0.1, 0.1], [0.9, 0.1], [0.9, 0.9], [0.1, 0.1], [0.9, 0.9], [0.1, 0.9]];
        let place = |sample: &TexelSample| -> DVec2 {
            let corner = |k: usize| DVec2::from(tex_coords[3 * sample.triangle + k].map(f64::from));
            sample.weights.x * corner(0) + sample.weights.y * corner(1) + sample.weights.z * corner(2)
        };
        let evaluate = |sample: &TexelSample| place(sample).extend(0.0).extend(1.0);
        for (border, covered, exact) in [(Border::Nearest, 2..18, 2..18), (Border::Continued, 1..19, 1..19)] {
            let baked = bake_texels(&tex_coords, |_| true, 20, 2, border, evaluate, &|_| true);
            let baked = baked.unwrap_or_else(|| unreachable!());
            for (y, x) in (0..20).flat_map(|y| (0..20).map(move |x| (y, x))) {
                let index = y * 20 + x;
                assert_eq!(baked.covered[index], covered.contains(&x) && covered.contains(&y), "{border:?}: {x} {y}");
                if exact.contains(&x) && exact.contains(&y) {
                    let [u, v, ..] = baked.values[index];
                    assert!((u - (x as f32 + 0.5) / 20.0).abs() < 1e-6, "{border:?}: {x} {y}: {u}");
                    assert!((v - (y as f32 + 0.5) / 20.0).abs() < 1e-6, "{border:?}: {x} {y}: {v}");
                }
            }
        }
    }
}
