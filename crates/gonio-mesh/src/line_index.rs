//! Converts byte positions to lines and columns.

use std::cell::OnceCell;

/// The starts of the lines of a text, computed on first use.
pub(crate) struct LineIndex<'a> {
    bytes: &'a [u8],
    starts: OnceCell<Vec<usize>>,
}

impl<'a> LineIndex<'a> {
    /// Creates an index of lines, which end at LF, CR LF or CR.
    pub(crate) fn new(bytes: &'a [u8]) -> Self {
        LineIndex { bytes, starts: OnceCell::new() }
    }

    /// Returns the line and the column (in bytes) of a byte, both from 1.
    pub(crate) fn place(&self, at: usize) -> (u64, u64) {
        let starts = self.starts.get_or_init(|| starts(self.bytes));
        let line = starts.partition_point(|&start| start <= at).max(1);
        let start = starts.get(line - 1).copied().unwrap_or(0);
        (line as u64, (at - start) as u64 + 1)
    }
}

fn starts(bytes: &[u8]) -> Vec<usize> {
    let mut starts = vec![0];
    for (at, &byte) in bytes.iter().enumerate() {
        if byte == b'\n' || (byte == b'\r' && bytes.get(at + 1) != Some(&b'\n')) {
            starts.push(at + 1);
        }
    }
    starts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_three_line_ends_count() {
        let index = LineIndex::new(b"a\nbc\r\nd\re");
        let places: Vec<(u64, u64)> = (0..10).map(|at| index.place(at)).collect();
        let expected = [(1, 1), (1, 2), (2, 1), (2, 2), (2, 3), (2, 4), (3, 1), (3, 2), (4, 1), (4, 2)];
        assert_eq!(places, expected);
        assert_eq!(LineIndex::new(b"").place(0), (1, 1));
    }
}
