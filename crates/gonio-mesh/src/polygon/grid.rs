//! Ear clipping for large polygons: corners that may be in an ear are found in a grid of cells.

use super::Cut;
use super::ears::Ring;
use glam::DVec2;

/// Most work per corner, on average, before the search is given up: the worst polygons would take time that grows with
/// the square of their size.
const MOST_WORK_PER_CORNER: usize = 400;

/// A polygon whose ears are being clipped.
struct Polygon<'a> {
    ring: Ring<'a>,
    /// Whether a corner remains and is not strictly convex.
    blocks: Vec<bool>,
    blocking: usize,
    grid: Grid,
    work: usize,
}

/// The corners in each cell.
struct Grid {
    min: DVec2,
    cells_per_unit: DVec2,
    side: usize,
    /// The start of each cell's corners in `corners`.
    starts: Vec<u32>,
    /// Corners by cell.
    corners: Vec<u32>,
}

/// Clips ears as [`super::ears`] does, in another order. Gives up after some time, and fans the rest.
///
/// Neighbours of an ear wait for the next round: clipped in sequence they would make a fan of ever longer triangles.
pub(super) fn cut_ears(ring: Ring<'_>, mut emit: impl FnMut([usize; 3])) -> Cut {
    let count = ring.left();
    let mut polygon = Polygon::new(ring);
    let most_work = MOST_WORK_PER_CORNER.saturating_mul(count);
    let mut cut = Cut::Ears;
    let mut here = 0;
    let mut candidates: Vec<u32> = (0..count as u32).collect();
    let (mut waiting, mut waits) = (Vec::new(), vec![false; count]);
    let mut is_everyone = true;
    while polygon.ring.left() > 3 {
        let left_before = polygon.ring.left();
        for &candidate in &candidates {
            let candidate = candidate as usize;
            if polygon.work > most_work {
                break;
            }
            let is_over = polygon.ring.left() == 3;
            if is_over || waits[candidate] || !polygon.ring.has(candidate) || !polygon.is_ear(candidate) {
                continue;
            }
            here = polygon.cut(candidate, &mut emit, &mut waiting, &mut waits);
        }
        if polygon.work > most_work && polygon.ring.left() > 3 {
            polygon.fan(here, emit);
            return Cut::TooLarge;
        }
        candidates.clear();
        candidates.append(&mut waiting);
        candidates.iter().for_each(|&waited| waits[waited as usize] = false);
        if polygon.ring.left() == left_before && is_everyone {
            // Without an ear the polygon is self-intersecting.
            cut = Cut::NotSimple;
            polygon.work += left_before;
            let victim = polygon.ring.least_bad(here);
            here = polygon.cut(victim, &mut emit, &mut waiting, &mut waits);
            candidates.append(&mut waiting);
            candidates.iter().for_each(|&waited| waits[waited as usize] = false);
        }
        is_everyone = candidates.is_empty();
        if is_everyone {
            // Others may have become ears when corners in them were clipped.
            candidates.extend((0..count as u32).filter(|&corner| polygon.ring.has(corner as usize)));
            polygon.work += count;
        }
    }
    let (before, after) = polygon.ring.neighbours(here);
    emit([before, here, after]);
    if polygon.ring.turn_at(here) < 0.0 { Cut::NotSimple } else { cut }
}

impl<'a> Polygon<'a> {
    fn new(ring: Ring<'a>) -> Self {
        let n = ring.left();
        let mut polygon =
            Polygon { grid: Grid::new(ring.points()), ring, blocks: vec![false; n], blocking: 0, work: 0 };
        (0..n).for_each(|corner| polygon.look_at(corner));
        polygon
    }

    /// Records whether a corner may be in an ear.
    fn look_at(&mut self, corner: usize) {
        let blocks = self.ring.turn_at(corner) <= 0.0;
        self.blocking = self.blocking + usize::from(blocks) - usize::from(self.blocks[corner]);
        self.blocks[corner] = blocks;
    }

    /// Clips a corner. Its neighbours wait for the next round. Returns the next corner.
    fn cut(
        &mut self,
        corner: usize,
        emit: &mut impl FnMut([usize; 3]),
        waiting: &mut Vec<u32>,
        waits: &mut [bool],
    ) -> usize {
        let (before, after) = self.ring.cut_off(corner);
        emit([before, corner, after]);
        self.blocking -= usize::from(self.blocks[corner]);
        self.blocks[corner] = false;
        for neighbour in [before, after] {
            self.look_at(neighbour);
            if !std::mem::replace(&mut waits[neighbour], true) {
                waiting.push(neighbour as u32);
            }
        }
        after
    }

    /// Whether a corner turns left and no other corner is in its triangle or on its border.
    fn is_ear(&mut self, corner: usize) -> bool {
        let [a, b, c] = self.ring.triangle(corner);
        self.work += 1;
        if self.ring.turn_at(corner) <= 0.0 {
            return false;
        }
        if self.blocking == 0 {
            return true;
        }
        let (low, high) = (self.grid.cell(a.min(b).min(c)), self.grid.cell(a.max(b).max(c)));
        for row in low[1]..=high[1] {
            // The cells of a row are consecutive.
            let row = row * self.grid.side;
            let range = self.grid.starts[row + low[0]] as usize..self.grid.starts[row + high[0] + 1] as usize;
            self.work += 1 + range.len();
            let blocks = |other| self.blocks[other] && self.ring.lies_in_triangle_at(other, corner);
            if self.grid.corners[range].iter().any(|&other| blocks(other as usize)) {
                return false;
            }
        }
        true
    }

    fn fan(&self, first: usize, mut emit: impl FnMut([usize; 3])) {
        let mut here = self.ring.after(first);
        for _ in 2..self.ring.left() {
            let after = self.ring.after(here);
            emit([first, here, after]);
            here = after;
        }
    }
}

impl Grid {
    /// Makes a grid with about one corner per cell.
    fn new(points: &[DVec2]) -> Self {
        let min = points.iter().fold(DVec2::INFINITY, |a, &b| a.min(b));
        let max = points.iter().fold(DVec2::NEG_INFINITY, |a, &b| a.max(b));
        let side = (points.len() as f64).sqrt().ceil().clamp(1.0, 2048.0) as usize;
        let cells_per_unit = DVec2::splat(side as f64) / (max - min);
        let mut grid = Grid { min, cells_per_unit, side, starts: vec![0; side * side + 1], corners: Vec::new() };
        let place = |grid: &Grid, point: DVec2| {
            let [column, row] = grid.cell(point);
            row * grid.side + column
        };
        for &point in points {
            let cell = place(&grid, point);
            grid.starts[cell + 1] += 1;
        }
        for cell in 0..side * side {
            grid.starts[cell + 1] += grid.starts[cell];
        }
        let mut next = grid.starts.clone();
        grid.corners = vec![0; points.len()];
        for (corner, &point) in points.iter().enumerate() {
            let cell = place(&grid, point);
            grid.corners[next[cell] as usize] = corner as u32;
            next[cell] += 1;
        }
        grid
    }

    /// Returns column and row. NaN (in a polygon without width) is cell 0.
    fn cell(&self, point: DVec2) -> [usize; 2] {
        let place = (point - self.min) * self.cells_per_unit;
        [place.x, place.y].map(|x| (x as usize).min(self.side - 1))
    }
}

#[cfg(test)]
mod tests {
    use super::super::turn;
    use super::*;

    /// Twice the areas of the triangles, and how many there are.
    fn cut(points: &[DVec2]) -> (Cut, Vec<f64>) {
        let mut areas = Vec::new();
        let mut links = vec![[0; 2]; points.len()];
        let ring = Ring::new(points, &mut links);
        let cut = cut_ears(ring, |[a, b, c]| areas.push(turn(points[a], points[b], points[c])));
        (cut, areas)
    }

    /// All triangles turn left and their areas are the polygon's (shoelace formula): they cover it once.
    fn check_covers(points: &[DVec2]) {
        let (cut, areas) = cut(points);
        assert_eq!((cut, areas.len()), (Cut::Ears, points.len() - 2));
        assert!(areas.iter().all(|&area| area > 0.0));
        let whole: f64 = (0..points.len()).map(|i| points[i].perp_dot(points[(i + 1) % points.len()])).sum();
        // Rounding of a sum of so many terms.
        assert!((areas.iter().sum::<f64>() - whole).abs() < 1e-9 * whole, "{whole}");
    }

    fn around(n: usize, radius: impl Fn(usize) -> f64) -> Vec<DVec2> {
        (0..n).map(|i| radius(i) * DVec2::from_angle(std::f64::consts::TAU * i as f64 / n as f64)).collect()
    }

    #[test]
    fn large_polygons_are_covered() {
        check_covers(&around(20_000, |i| if i % 2 == 0 { 1.0 } else { 0.9 }));
        check_covers(&around(50_000, |i| 1.0 + 0.3 * (0.013 * i as f64).sin() + 0.01 * (0.7 * i as f64).sin()));
        // A spiral of 40 rounds, out and back.
        let arm = |i: usize, width: f64| (1.0 + 0.01 * i as f64 + width) * DVec2::from_angle(0.05 * i as f64);
        let mut spiral: Vec<DVec2> = (0..5000).map(|i| arm(i, 0.5)).collect();
        spiral.extend((0..5000).rev().map(|i| arm(i, 0.0)));
        check_covers(&spiral);
    }

    #[test]
    fn what_cannot_be_cut_in_time_is_cut_somehow() {
        // Every spike crosses the middle: each triangle's box is the whole polygon.
        let spikes = around(40_000, |i| if i % 2 == 0 { 1.0 } else { -1.0 });
        let (_, areas) = cut(&spikes);
        assert_eq!(areas.len(), spikes.len() - 2);
        for points in [vec![DVec2::ONE; 10_000], (0..10_000).map(|i| DVec2::splat(f64::from(i % 100))).collect()] {
            let (cut, areas) = cut(&points);
            assert!(cut != Cut::Ears || areas.iter().all(|area| *area == 0.0));
            assert_eq!(areas.len(), points.len() - 2);
        }
    }
}
