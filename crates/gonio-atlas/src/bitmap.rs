//! Sets of cells of a square grid, as rows of bits.

use glam::DVec2;

/// Rows of bits, 64 to a word.
#[derive(Clone, Debug)]
pub(crate) struct Bitmap {
    pub width: usize,
    pub height: usize,
    words: usize,
    bits: Vec<u64>,
}

impl Bitmap {
    pub fn new(width: usize, height: usize) -> Self {
        let words = width.div_ceil(64).max(1);
        Bitmap { width, height, words, bits: vec![0; words * height] }
    }

    pub fn row(&self, y: usize) -> &[u64] {
        &self.bits[y * self.words..][..self.words]
    }

    fn row_mut(&mut self, y: usize) -> &mut [u64] {
        &mut self.bits[y * self.words..][..self.words]
    }

    /// Sets the cells from `start` to before `end`, as far as they exist.
    pub fn set_run(&mut self, y: usize, start: usize, end: usize) {
        let end = end.min(self.width);
        if start >= end {
            return;
        }
        let (first, last) = (start / 64, (end - 1) / 64);
        let row = self.row_mut(y);
        for (word, bits) in row.iter_mut().enumerate().take(last + 1).skip(first) {
            let low = if word == first { u64::MAX << (start % 64) } else { u64::MAX };
            let high = if word == last { u64::MAX >> (63 - (end - 1) % 64) } else { u64::MAX };
            *bits |= low & high;
        }
    }

    /// The maximal runs of set cells in a row, as (start, end).
    pub fn runs(&self, y: usize) -> Vec<(usize, usize)> {
        runs(self.row(y), self.width, true)
    }

    /// The length of the longest run of free cells in a row.
    pub fn longest_free_run(&self, y: usize) -> usize {
        runs(self.row(y), self.width, false).into_iter().map(|(start, end)| end - start).max().unwrap_or(0)
    }

    /// The cells that a polygon touches, given by its border in any order: those that an edge runs through, and those
    /// whose centre is inside by the even-odd rule. Cells are 1 x 1, the first one at the origin.
    pub fn of_polygon(border: &[[DVec2; 2]], width: usize, height: usize) -> Bitmap {
        let mut bitmap = Bitmap::new(width, height);
        let mut crossings: Vec<Vec<f64>> = vec![Vec::new(); height];
        for &[a, b] in border {
            let (low, high) = if a.y <= b.y { (a, b) } else { (b, a) };
            bitmap.touch_edge(low, high);
            // Rows whose centre lies in [low.y, high.y).
            let first = (low.y - 0.5).ceil().max(0.0) as usize;
            let slope = (high.x - low.x) / (high.y - low.y);
            for (y, row) in crossings.iter_mut().enumerate().skip(first) {
                let center = y as f64 + 0.5;
                if center >= high.y {
                    break;
                }
                row.push(low.x + slope * (center - low.y));
            }
        }
        for (y, row) in crossings.iter_mut().enumerate() {
            row.sort_unstable_by(f64::total_cmp);
            for pair in row.as_chunks::<2>().0 {
                bitmap.set_run(y, (pair[0] - 0.5).ceil().max(0.0) as usize, (pair[1] - 0.5).ceil().max(0.0) as usize);
            }
        }
        bitmap
    }

    /// Sets the cells that an edge runs through; `low` is its lower end.
    fn touch_edge(&mut self, low: DVec2, high: DVec2) {
        let slope = (high.x - low.x) / (high.y - low.y).max(1e-12);
        let last = (high.y.floor().max(0.0) as usize).min(self.height.saturating_sub(1));
        for y in low.y.floor().max(0.0) as usize..=last {
            let at = |row: f64| low.x + slope * (row.clamp(low.y, high.y) - low.y);
            let (mut x0, mut x1) = (at(y as f64), at(y as f64 + 1.0));
            if high.y - low.y < 1e-9 {
                (x0, x1) = (low.x, high.x);
            }
            self.set_run(y, x0.min(x1).floor().max(0.0) as usize, x0.max(x1).floor().max(0.0) as usize + 1);
        }
    }

    /// Sets all cells nearer than `margin` (in cells) to those that `shape` would have at (x, y): a point of one cell
    /// and a point of another are at least as far apart as the cells, less one each way. Returns the changed rows.
    pub fn add_with_margin(&mut self, shape: &Bitmap, x: usize, y: usize, margin: f64) -> std::ops::Range<usize> {
        let reach = margin.ceil() as usize;
        let half_width = |dy: usize| {
            let vertical = dy.saturating_sub(1) as f64;
            let left = margin * margin - vertical * vertical;
            if left <= 0.0 { None } else { Some(left.sqrt().ceil() as usize) }
        };
        for shape_y in 0..shape.height {
            let runs = shape.runs(shape_y);
            for dy in -(reach as isize)..=reach as isize {
                let row = (y + shape_y) as isize + dy;
                let Some(half) = half_width(dy.unsigned_abs()) else { continue };
                if row < 0 || row as usize >= self.height {
                    continue;
                }
                for &(start, end) in &runs {
                    self.set_run(row as usize, (x + start).saturating_sub(half), x + end + half);
                }
            }
        }
        y.saturating_sub(reach)..(y + shape.height + reach).min(self.height)
    }
}

/// Runs of bits that equal `wanted`.
fn runs(row: &[u64], width: usize, wanted: bool) -> Vec<(usize, usize)> {
    let word = |i: usize| if wanted { row[i] } else { !row[i] };
    let next = |from: usize, set: bool| {
        let mut i = from / 64;
        let mut mask = u64::MAX << (from % 64);
        while i < row.len() {
            let bits = (if set { word(i) } else { !word(i) }) & mask;
            if bits != 0 {
                return (64 * i + bits.trailing_zeros() as usize).min(width);
            }
            (i, mask) = (i + 1, u64::MAX);
        }
        width
    };
    let mut runs = Vec::new();
    let mut at = 0;
    while at < width {
        let start = next(at, true);
        if start >= width {
            break;
        }
        at = next(start, false);
        runs.push((start, at));
    }
    runs
}

/// Adds to `blocked` each column x for which a run of `length` cells from x + `offset` would hit a set cell of `row`.
pub(crate) fn add_blocked(blocked: &mut [u64], row: &[u64], offset: usize, length: usize, scratch: &mut Vec<u64>) {
    scratch.clear();
    scratch.extend_from_slice(row);
    let mut covered = 1;
    while covered < length {
        let step = covered.min(length - covered);
        or_shifted(scratch, step);
        covered += step;
    }
    let (words, bits) = (offset / 64, offset % 64);
    for i in 0..blocked.len().saturating_sub(words) {
        let low = scratch[i + words] >> bits;
        let high = if bits == 0 { 0 } else { scratch.get(i + words + 1).map_or(0, |next| next << (64 - bits)) };
        blocked[i] |= low | high;
    }
}

/// row |= row moved down by `step` bits; words are read before they change.
fn or_shifted(row: &mut [u64], step: usize) {
    let (words, bits) = (step / 64, step % 64);
    let count = row.len();
    for i in 0..count.saturating_sub(words) {
        let low = row[i + words] >> bits;
        let high = if bits == 0 || i + words + 1 >= count { 0 } else { row[i + words + 1] << (64 - bits) };
        row[i] |= low | high;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_cross_words() {
        let mut bitmap = Bitmap::new(150, 1);
        bitmap.set_run(0, 60, 130);
        bitmap.set_run(0, 2, 3);
        bitmap.set_run(0, 149, 400);
        assert_eq!(bitmap.runs(0), [(2, 3), (60, 130), (149, 150)]);
        assert_eq!(bitmap.longest_free_run(0), 57);
    }

    /// Every column and length, against the plain definition.
    #[test]
    fn blocked_columns_are_those_where_a_run_hits_a_cell() {
        let mut bitmap = Bitmap::new(200, 1);
        for (start, end) in [(5, 6), (63, 65), (100, 131), (190, 199)] {
            bitmap.set_run(0, start, end);
        }
        let is_set = |x: usize| x < 200 && bitmap.row(0)[x / 64] >> (x % 64) & 1 == 1;
        for (offset, length) in [(0, 1), (3, 2), (64, 7), (10, 64), (70, 65), (1, 100)] {
            let mut blocked = vec![0; bitmap.row(0).len()];
            add_blocked(&mut blocked, bitmap.row(0), offset, length, &mut Vec::new());
            for x in 0..200 - offset - length {
                let hits = (x + offset..x + offset + length).any(is_set);
                assert_eq!(blocked[x / 64] >> (x % 64) & 1 == 1, hits, "column {x}, offset {offset}, length {length}");
            }
        }
    }

    #[test]
    fn a_polygon_touches_its_border_and_its_inside() {
        let at = |x: f64, y: f64| DVec2::new(x, y);
        let corners = [at(1.2, 1.1), at(8.5, 1.1), at(8.5, 6.3), at(1.2, 6.3)];
        let border: Vec<[DVec2; 2]> = (0..4).map(|i| [corners[i], corners[(i + 1) % 4]]).collect();
        let bitmap = Bitmap::of_polygon(&border, 12, 9);
        for y in 0..9 {
            let expected: &[(usize, usize)] = if (1..=6).contains(&y) { &[(1, 9)] } else { &[] };
            assert_eq!(bitmap.runs(y), expected, "row {y}");
        }
    }
}
