//! Ear clipping with a simple search.

use super::ring::Ring;
use super::{Cut, turn};

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
