//! What is left of a polygon while its corners are cut off.

use super::turn;
use glam::DVec2;

/// In place of the corner after one that is cut off.
const REMOVED: u32 = u32::MAX;

/// The corners of a projected polygon, each linked to the ones beside it.
pub(super) struct Ring<'a> {
    points: &'a [DVec2],
    /// The corner before each, and the one after.
    links: &'a mut [[u32; 2]],
    left: usize,
}

impl<'a> Ring<'a> {
    /// All of a polygon. `links` is memory for as many.
    pub(super) fn new(points: &'a [DVec2], links: &'a mut [[u32; 2]]) -> Self {
        let last = points.len() as u32 - 1;
        for (corner, link) in (0..).zip(links.iter_mut()) {
            *link = [if corner == 0 { last } else { corner - 1 }, if corner == last { 0 } else { corner + 1 }];
        }
        Ring { points, links, left: points.len() }
    }

    /// All points, those that are cut off too.
    pub(super) fn points(&self) -> &'a [DVec2] {
        self.points
    }

    /// How many corners are left.
    pub(super) fn left(&self) -> usize {
        self.left
    }

    /// Whether a corner is left.
    pub(super) fn has(&self, corner: usize) -> bool {
        self.links[corner][1] != REMOVED
    }

    /// The corners beside one: before and after.
    #[inline(always)]
    pub(super) fn neighbours(&self, corner: usize) -> (usize, usize) {
        let [before, after] = self.links[corner];
        (before as usize, after as usize)
    }

    /// The corner after one.
    pub(super) fn after(&self, corner: usize) -> usize {
        self.links[corner][1] as usize
    }

    /// The points of a corner and those beside it.
    #[inline(always)]
    pub(super) fn triangle(&self, corner: usize) -> [DVec2; 3] {
        let (before, after) = self.neighbours(corner);
        [self.points[before], self.points[corner], self.points[after]]
    }

    /// How far the polygon turns to the left there: see [`turn`].
    #[inline(always)]
    pub(super) fn turn_at(&self, corner: usize) -> f64 {
        let [a, b, c] = self.triangle(corner);
        turn(a, b, c)
    }

    /// Whether a corner that is not strictly convex lies in the triangle at another, or on its border.
    #[inline(always)]
    pub(super) fn lies_in_triangle_at(&self, other: usize, corner: usize) -> bool {
        let (before, after) = self.neighbours(corner);
        let [a, b, c] = self.triangle(corner);
        let p = self.points[other];
        other != before
            && other != after
            && p != a
            && p != b
            && p != c
            && turn(a, b, p) >= 0.0
            && turn(b, c, p) >= 0.0
            && turn(c, a, p) >= 0.0
    }

    /// Takes a corner away; returns the ones that were beside it.
    #[inline(always)]
    pub(super) fn cut_off(&mut self, corner: usize) -> (usize, usize) {
        let (before, after) = self.neighbours(corner);
        self.links[before][1] = after as u32;
        self.links[after][0] = before as u32;
        self.links[corner][1] = REMOVED;
        self.left -= 1;
        (before, after)
    }

    /// Where no corner is an ear: one without area, or else the smallest that turns left.
    pub(super) fn least_bad(&self, start: usize) -> usize {
        let mut best = (f64::INFINITY, start);
        let mut here = start;
        for _ in 0..self.left {
            let area = self.turn_at(here);
            let badness = if area < 0.0 { f64::MAX } else { area };
            if badness < best.0 {
                best = (badness, here);
            }
            here = self.after(here);
        }
        best.1
    }
}
