//! The exact area of a polygon in each pixel.
//!
//! An edge adds the signed area between itself and the right side to each pixel that it crosses, and its height to all
//! pixels further right. Each row stores differences instead of sums, so an edge changes only the pixels that it crosses; a
//! running sum along the row gives the coverage. This is the accumulation buffer of Raph Levien's font-rs (2016),
//! reimplemented.

use crate::kurbo::Point;

/// Differences of coverage along each row.
pub struct Coverage {
    width: usize,
    height: usize,
    /// One value more in each row than pixels, for the area right of the last pixel.
    differences: Vec<f32>,
}

impl Coverage {
    /// Empty.
    pub fn new(width: u16, height: u16) -> Self {
        let (width, height) = (usize::from(width), usize::from(height));
        Coverage { width, height, differences: vec![0.0; (width + 1) * height] }
    }

    /// Adds an edge. Parts left or right of the picture count as if on that border; parts above or below do not count.
    pub fn line(&mut self, from: Point, to: Point) {
        let (sign, (x0, y0), (x1, y1)) = if from.1 < to.1 { (1.0, from, to) } else { (-1.0, to, from) };
        // Also true for NaN.
        if !(y1 - y0 > 0.0 && (x1 - x0).is_finite()) {
            return;
        }
        let slope = (x1 - x0) / (y1 - y0);
        let (top, bottom) = (y0.max(0.0), y1.min(self.height as f64));
        let (first, end) = (top as usize, bottom.ceil().max(0.0) as usize);
        for (row, differences) in self.differences.chunks_exact_mut(self.width + 1).enumerate().take(end).skip(first) {
            let (start, stop) = (top.max(row as f64), bottom.min((row + 1) as f64));
            let at = |y: f64| (x0 + (y - y0) * slope).clamp(0.0, self.width as f64);
            add(differences, at(start), at(stop), sign * (stop - start));
        }
    }

    /// The coverage of each pixel, 0 to 1, row by row.
    pub fn pixels(&self) -> impl Iterator<Item = f32> + '_ {
        self.differences.chunks_exact(self.width + 1).flat_map(|row| {
            let mut sum = 0.0;
            row.iter().take(self.width).map(move |difference| {
                sum += difference;
                sum.abs().min(1.0)
            })
        })
    }
}

/// Adds the part of an edge within one row, from x `a` to x `b`, with the signed height `height`.
fn add(differences: &mut [f32], a: f64, b: f64, height: f64) {
    let (left, right) = (a.min(b), a.max(b));
    let mut before = 0.0;
    for (column, difference) in differences.iter_mut().enumerate().skip(left as usize) {
        // The share right of the edge, of the pixels up to this one's right side.
        let share = mean_right_of(left, right, column as f64, (column + 1) as f64);
        *difference += (height * (share - before)) as f32;
        before = share;
        if share >= 1.0 {
            break;
        }
    }
}

/// The share of the pixels from `start` to `end` that is right of a straight edge from `left` to `right`.
fn mean_right_of(left: f64, right: f64, start: f64, end: f64) -> f64 {
    if end >= right && start >= right {
        return 1.0;
    }
    let width = right - left;
    if width < 1e-9 {
        return (end - left).clamp(0.0, 1.0);
    }
    // The integral over the edge of max(0, c - x) is a parabola up to `right` and a line from there.
    let up_to = |c: f64| {
        let (all, beyond) = ((c - left).max(0.0), (c - right).max(0.0));
        (all * all - beyond * beyond) / (2.0 * width)
    };
    (up_to(end) - up_to(start)).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn polygon(width: u16, height: u16, corners: &[Point]) -> Vec<f32> {
        let mut coverage = Coverage::new(width, height);
        for (from, to) in corners.iter().zip(corners.iter().cycle().skip(1)) {
            coverage.line(*from, *to);
        }
        coverage.pixels().collect()
    }

    /// The rounding error of sums of a few f32.
    const ROUNDING: f32 = 1e-5;

    #[track_caller]
    fn assert_near(found: &[f32], expected: &[f32]) {
        assert_eq!(found.len(), expected.len());
        for (index, (a, b)) in found.iter().zip(expected).enumerate() {
            assert!((a - b).abs() < ROUNDING, "pixel {index}: {a} instead of {b}: {found:?}");
        }
    }

    #[test]
    fn a_rectangle_covers_what_it_covers() {
        let found = polygon(4, 3, &[(0.5, 0.25), (3.25, 0.25), (3.25, 2.0), (0.5, 2.0)]);
        let top = [0.5 * 0.75, 0.75, 0.75, 0.25 * 0.75];
        let middle = [0.5, 1.0, 1.0, 0.25];
        assert_near(&found, &[top, middle, [0.0; 4]].concat());
    }

    #[test]
    fn direction_does_not_matter() {
        let corners = [(0.3, 0.1), (2.9, 1.2), (1.1, 2.8)];
        let reversed: Vec<Point> = corners.iter().rev().copied().collect();
        assert_near(&polygon(3, 3, &corners), &polygon(3, 3, &reversed));
    }

    #[test]
    fn areas_of_triangles_are_exact() {
        // Two pixels under a slanted edge: the area is the integral of a line.
        assert_near(&polygon(2, 1, &[(0.0, 1.0), (2.0, 0.0), (2.0, 1.0)]), &[0.25, 0.75]);
        let corners = [(0.3, 0.1), (6.9, 2.2), (2.1, 6.8)];
        let sum: f32 = polygon(7, 7, &corners).iter().sum();
        // Half the cross product of two sides.
        let area = 0.5 * ((6.9 - 0.3) * (6.8 - 0.1) - (2.1 - 0.3) * (2.2 - 0.1));
        assert!((f64::from(sum) - area).abs() < 1e-4, "{sum} instead of {area}");
    }

    #[test]
    fn what_lies_outside_is_cut_off() {
        assert_near(&polygon(2, 2, &[(-5.0, -5.0), (1.0, -5.0), (1.0, 9.0), (-5.0, 9.0)]), &[1.0, 0.0, 1.0, 0.0]);
        assert_near(&polygon(2, 1, &[(5.0, 0.0), (9.0, 0.0), (9.0, 1.0), (5.0, 1.0)]), &[0.0, 0.0]);
        let nothing = f64::NAN;
        assert_near(&polygon(1, 1, &[(nothing, 0.0), (1.0, nothing), (nothing, 1.0)]), &[0.0]);
    }

    #[test]
    fn a_hole_is_left_out_and_an_overlap_counts_once() {
        let mut coverage = Coverage::new(3, 3);
        let mut square = |a: f64, b: f64, reversed: bool| {
            let mut corners = [(a, a), (b, a), (b, b), (a, b)];
            if reversed {
                corners.reverse();
            }
            for (from, to) in corners.iter().zip(corners.iter().cycle().skip(1)) {
                coverage.line(*from, *to);
            }
        };
        square(0.0, 3.0, false);
        square(1.0, 2.0, true);
        square(0.0, 1.0, false);
        let found: Vec<f32> = coverage.pixels().collect();
        assert_near(&found, &[1.0, 1.0, 1.0, 1.0, 0.0, 1.0, 1.0, 1.0, 1.0]);
    }
}
