//! Ear clipping with a simple search, and the remaining corners of a polygon while it is clipped.

use super::{Cut, turn};
use glam::DVec2;

/// Clips ears (G. H. Meisters, 1975, "Polygons have ears") until a triangle is left. `blocking` is a buffer with a bit
/// for each corner.
pub(super) fn cut(mut ring: Ring<'_>, blocking: &mut [u64], mut emit: impl FnMut([usize; 3])) -> Cut {
    blocking.fill(0);
    let mut blocking = Blocking(blocking);
    (0..ring.left()).for_each(|corner| blocking.look_at(&ring, corner));
    let mut cut = Cut::Ears;
    let mut here = 0;
    let mut fruitless = 0;
    while ring.left() > 3 {
        if is_ear(&ring, &blocking, here) {
            fruitless = 0;
        } else if fruitless < ring.left() {
            fruitless += 1;
            here = ring.after(here);
            continue;
        } else {
            // Without an ear the polygon is self-intersecting. Clip the corner nearest to an ear.
            cut = Cut::NotSimple;
            fruitless = 0;
            here = ring.least_bad(here);
        }
        let (before, after) = ring.cut_off(here);
        emit([before, here, after]);
        // Only the neighbours' angles changed.
        blocking.set(here, false);
        blocking.look_at(&ring, before);
        blocking.look_at(&ring, after);
        here = after;
    }
    let (before, after) = ring.neighbours(here);
    emit([before, here, after]);
    if ring.turn_at(here) < 0.0 { Cut::NotSimple } else { cut }
}

/// Whether a corner turns left and no other corner is in its triangle or on its border.
fn is_ear(ring: &Ring<'_>, blocking: &Blocking<'_>, corner: usize) -> bool {
    let [a, b, c] = ring.triangle(corner);
    turn(a, b, c) > 0.0 && !blocking.any(|other| ring.lies_in_triangle_at(other, corner))
}

/// Corners that may be in an ear: those that remain and are not strictly convex.
struct Blocking<'a>(&'a mut [u64]);

impl Blocking<'_> {
    #[inline(always)]
    fn set(&mut self, corner: usize, blocks: bool) {
        let word = &mut self.0[corner / 64];
        *word = *word & !(1 << (corner % 64)) | u64::from(blocks) << (corner % 64);
    }

    #[inline(always)]
    fn look_at(&mut self, ring: &Ring<'_>, corner: usize) {
        self.set(corner, ring.turn_at(corner) <= 0.0);
    }

    /// Whether a condition holds for one of them.
    #[inline(always)]
    fn any(&self, is: impl Fn(usize) -> bool) -> bool {
        for (i, word) in self.0.iter().enumerate() {
            let mut rest = *word;
            while rest != 0 {
                if is(64 * i + rest.trailing_zeros() as usize) {
                    return true;
                }
                rest &= rest - 1;
            }
        }
        false
    }
}

/// Marks a clipped corner in place of the next one.
const REMOVED: u32 = u32::MAX;

/// The corners of a projected polygon, each linked to the ones beside it.
pub(super) struct Ring<'a> {
    points: &'a [DVec2],
    /// The previous and the next corner.
    links: &'a mut [[u32; 2]],
    left: usize,
}

impl<'a> Ring<'a> {
    /// Creates the ring of all corners. `links` is a buffer of the same length.
    pub(super) fn new(points: &'a [DVec2], links: &'a mut [[u32; 2]]) -> Self {
        let last = points.len() as u32 - 1;
        for (corner, link) in (0..).zip(links.iter_mut()) {
            *link = [if corner == 0 { last } else { corner - 1 }, if corner == last { 0 } else { corner + 1 }];
        }
        Ring { points, links, left: points.len() }
    }

    /// Returns all points, including clipped ones.
    pub(super) fn points(&self) -> &'a [DVec2] {
        self.points
    }

    /// Returns the number of remaining corners.
    pub(super) fn left(&self) -> usize {
        self.left
    }

    /// Whether a corner remains.
    pub(super) fn has(&self, corner: usize) -> bool {
        self.links[corner][1] != REMOVED
    }

    /// Returns the previous and the next corner.
    #[inline(always)]
    pub(super) fn neighbours(&self, corner: usize) -> (usize, usize) {
        let [before, after] = self.links[corner];
        (before as usize, after as usize)
    }

    pub(super) fn after(&self, corner: usize) -> usize {
        self.links[corner][1] as usize
    }

    /// Returns the points of the previous corner, of this one and of the next one.
    #[inline(always)]
    pub(super) fn triangle(&self, corner: usize) -> [DVec2; 3] {
        let (before, after) = self.neighbours(corner);
        [self.points[before], self.points[corner], self.points[after]]
    }

    /// Returns how far the polygon turns to the left at a corner: see [`turn`].
    #[inline(always)]
    pub(super) fn turn_at(&self, corner: usize) -> f64 {
        let [a, b, c] = self.triangle(corner);
        turn(a, b, c)
    }

    /// Whether a corner that is not strictly convex is in the triangle at another, or on its border.
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

    /// Clips a corner; returns its neighbours.
    #[inline(always)]
    pub(super) fn cut_off(&mut self, corner: usize) -> (usize, usize) {
        let (before, after) = self.neighbours(corner);
        self.links[before][1] = after as u32;
        self.links[after][0] = before as u32;
        self.links[corner][1] = REMOVED;
        self.left -= 1;
        (before, after)
    }

    /// Returns the corner to clip if none is an ear: one without area, or else the smallest one that turns left.
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
