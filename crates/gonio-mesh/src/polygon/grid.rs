//! Ears of large polygons: corners that may lie in one are found by their place, in a grid of cells.

use super::{Cut, turn};
use glam::DVec2;

/// Work that a corner may cause on average before the search is given up: the worst polygons would take time that grows
/// with the square of their size.
const MOST_WORK_PER_CORNER: usize = 400;

/// In place of the corner after one that is cut off.
const REMOVED: u32 = u32::MAX;

/// A polygon whose ears are being cut off.
struct Polygon<'a> {
    points: &'a [DVec2],
    previous: Vec<u32>,
    next: Vec<u32>,
    /// Corners that are left and not strictly convex.
    blocks: Vec<bool>,
    blocking: usize,
    grid: Grid,
    work: usize,
}

/// Which corners lie in which cell.
struct Grid {
    min: DVec2,
    cells_per_unit: DVec2,
    side: usize,
    /// Where each cell's corners begin, ...
    starts: Vec<u32>,
    /// ... in this list.
    corners: Vec<u32>,
}

/// Cuts ears off as [`super::Triangulator`] does, in another order. Gives up in time, and fans what is left.
///
/// Neighbours of an ear wait for the next round: cut one after the other they would make a fan of ever longer triangles.
pub(super) fn cut_ears(points: &[DVec2], mut emit: impl FnMut([usize; 3])) -> Cut {
    let mut polygon = Polygon::new(points);
    let most_work = MOST_WORK_PER_CORNER.saturating_mul(points.len());
    let mut cut = Cut::Ears;
    let (mut here, mut left) = (0, points.len());
    let mut candidates: Vec<u32> = (0..points.len() as u32).collect();
    let (mut waiting, mut waits) = (Vec::new(), vec![false; points.len()]);
    let mut is_everyone = true;
    while left > 3 {
        let left_before = left;
        for &candidate in &candidates {
            let candidate = candidate as usize;
            if polygon.work > most_work {
                break;
            }
            if left == 3 || waits[candidate] || !polygon.is_left(candidate) || !polygon.is_ear(candidate) {
                continue;
            }
            here = polygon.cut(candidate, &mut emit, &mut waiting, &mut waits);
            left -= 1;
        }
        if polygon.work > most_work && left > 3 {
            polygon.fan(here, left, emit);
            return Cut::TooLarge;
        }
        candidates.clear();
        candidates.append(&mut waiting);
        candidates.iter().for_each(|&waited| waits[waited as usize] = false);
        if left == left_before && is_everyone {
            // No ear: it crosses or touches itself.
            cut = Cut::NotSimple;
            let victim = polygon.least_bad(here, left);
            here = polygon.cut(victim, &mut emit, &mut waiting, &mut waits);
            left -= 1;
            candidates.append(&mut waiting);
            candidates.iter().for_each(|&waited| waits[waited as usize] = false);
        }
        is_everyone = candidates.is_empty();
        if is_everyone {
            // Others may have become ears when what lay in them went away.
            candidates.extend((0..points.len() as u32).filter(|&corner| polygon.is_left(corner as usize)));
            polygon.work += points.len();
        }
    }
    let (before, after) = polygon.neighbours(here);
    emit([before, here, after]);
    if polygon.turn_at(here) < 0.0 { Cut::NotSimple } else { cut }
}

impl<'a> Polygon<'a> {
    fn new(points: &'a [DVec2]) -> Self {
        let n = points.len();
        let mut polygon = Polygon {
            points,
            previous: (0..n).map(|i| ((i + n - 1) % n) as u32).collect(),
            next: (0..n).map(|i| ((i + 1) % n) as u32).collect(),
            blocks: vec![false; n],
            blocking: 0,
            grid: Grid::new(points),
            work: 0,
        };
        (0..n).for_each(|corner| polygon.look_at(corner));
        polygon
    }

    fn neighbours(&self, corner: usize) -> (usize, usize) {
        (self.previous[corner] as usize, self.next[corner] as usize)
    }

    fn turn_at(&self, corner: usize) -> f64 {
        let (before, after) = self.neighbours(corner);
        turn(self.points[before], self.points[corner], self.points[after])
    }

    /// Notes whether a corner may lie in an ear.
    fn look_at(&mut self, corner: usize) {
        let blocks = self.turn_at(corner) <= 0.0;
        self.blocking = self.blocking + usize::from(blocks) - usize::from(self.blocks[corner]);
        self.blocks[corner] = blocks;
    }

    fn is_left(&self, corner: usize) -> bool {
        self.next[corner] != REMOVED
    }

    /// Cuts a corner off. Its neighbours are to wait. Returns the one behind.
    fn cut(
        &mut self,
        corner: usize,
        emit: &mut impl FnMut([usize; 3]),
        waiting: &mut Vec<u32>,
        waits: &mut [bool],
    ) -> usize {
        let (before, after) = self.neighbours(corner);
        emit([before, corner, after]);
        self.blocking -= usize::from(self.blocks[corner]);
        self.blocks[corner] = false;
        self.next[before] = after as u32;
        self.previous[after] = before as u32;
        self.next[corner] = REMOVED;
        for neighbour in [before, after] {
            self.look_at(neighbour);
            if !std::mem::replace(&mut waits[neighbour], true) {
                waiting.push(neighbour as u32);
            }
        }
        after
    }

    /// A corner that turns left and whose triangle holds no other corner, its border included.
    fn is_ear(&mut self, corner: usize) -> bool {
        let (before, after) = self.neighbours(corner);
        let [a, b, c] = [before, corner, after].map(|i| self.points[i]);
        self.work += 1;
        if turn(a, b, c) <= 0.0 {
            return false;
        }
        if self.blocking == 0 {
            return true;
        }
        let (low, high) = (self.grid.cell(a.min(b).min(c)), self.grid.cell(a.max(b).max(c)));
        for row in low[1]..=high[1] {
            // The cells of a row follow one another.
            let row = row * self.grid.side;
            let range = self.grid.starts[row + low[0]] as usize..self.grid.starts[row + high[0] + 1] as usize;
            self.work += 1 + range.len();
            for &other in &self.grid.corners[range] {
                let p = self.points[other as usize];
                let lies_in_it = self.blocks[other as usize]
                    && other as usize != before
                    && other as usize != after
                    && p != a
                    && p != b
                    && p != c
                    && turn(a, b, p) >= 0.0
                    && turn(b, c, p) >= 0.0
                    && turn(c, a, p) >= 0.0;
                if lies_in_it {
                    return false;
                }
            }
        }
        true
    }

    /// A corner without area, or else the smallest that turns left.
    fn least_bad(&mut self, start: usize, left: usize) -> usize {
        self.work += left;
        let mut best = (f64::INFINITY, start);
        let mut here = start;
        for _ in 0..left {
            let area = self.turn_at(here);
            let badness = if area < 0.0 { f64::MAX } else { area };
            if badness < best.0 {
                best = (badness, here);
            }
            here = self.next[here] as usize;
        }
        best.1
    }

    fn fan(&self, first: usize, left: usize, mut emit: impl FnMut([usize; 3])) {
        let mut here = self.next[first] as usize;
        for _ in 2..left {
            let after = self.next[here] as usize;
            emit([first, here, after]);
            here = after;
        }
    }
}

impl Grid {
    /// About one corner in each cell.
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

    /// Column and row. What is no number (of a polygon without width) is cell 0.
    fn cell(&self, point: DVec2) -> [usize; 2] {
        let place = (point - self.min) * self.cells_per_unit;
        [place.x, place.y].map(|x| (x as usize).min(self.side - 1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Twice the areas of the triangles, and how many there are.
    fn cut(points: &[DVec2]) -> (Cut, Vec<f64>) {
        let mut areas = Vec::new();
        let cut = cut_ears(points, |[a, b, c]| areas.push(turn(points[a], points[b], points[c])));
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
