//! Splits a file for several threads. The number of pieces does not change the result.

use super::attributes::Segment;
use std::ops::Range;

/// How to read a file. It does not affect the result.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plan {
    /// Most pieces for the first pass.
    pub(super) pieces: usize,
    /// Most ranges for the second pass; each has a table of vertices of its own.
    pub(super) stretches: usize,
    /// Whether lines in plain form take the fast path.
    pub(super) fast_path: bool,
}

/// Least size of a piece in bytes.
const SMALLEST_PIECE: usize = 1 << 19;

impl Plan {
    /// Chooses a plan for a file's size and the available threads.
    pub(super) fn for_size(size: usize) -> Self {
        let most = size / SMALLEST_PIECE;
        // Only asked when needed, because asking may start the threads.
        let threads = if most < 2 { 1 } else { rayon::current_num_threads() };
        let for_each = |count: usize| if threads < 2 { 1 } else { (count * threads).min(most) };
        Plan { pieces: for_each(8), stretches: for_each(1), fast_path: true }
    }
}

/// Splits a file where statements begin, into consecutive pieces of similar size.
pub(super) fn split(bytes: &[u8], most: usize) -> Vec<Range<usize>> {
    let mut pieces = Vec::with_capacity(most);
    let mut start = 0;
    for i in 1..most {
        let aim = (bytes.len() as u128 * i as u128 / most as u128) as usize;
        if aim <= start {
            continue;
        }
        let Some(next) = statement_behind(bytes, aim) else { break };
        pieces.push(start..next);
        start = next;
    }
    pieces.push(start..bytes.len());
    pieces
}

/// Returns the first position from `at` on where a statement certainly begins: after a line end that no `\` precedes.
fn statement_behind(bytes: &[u8], at: usize) -> Option<usize> {
    let mut at = at;
    loop {
        let end = at + bytes.get(at..)?.iter().position(|byte| matches!(byte, b'\n' | b'\r'))?;
        let is_second = bytes[end] == b'\n' && end > 0 && bytes[end - 1] == b'\r';
        let line = &bytes[..end - usize::from(is_second)];
        let is_first = bytes[end] == b'\r' && bytes.get(end + 1) == Some(&b'\n');
        at = end + if is_first { 2 } else { 1 };
        // Blanks may be between `\` and the line end; after more than a few, it is easier to give up.
        const MOST_BLANKS: usize = 64;
        let tail = &line[line.len().saturating_sub(MOST_BLANKS)..];
        match tail.iter().rev().find(|byte| !matches!(byte, b' ' | b'\t')) {
            Some(b'\\') => {}
            None if tail.len() == MOST_BLANKS => {}
            _ if at < bytes.len() => return Some(at),
            _ => return None,
        }
    }
}

/// Groups consecutive segments into ranges of similar size.
pub(super) fn stretches(segments: &[Segment], most: usize) -> Vec<&[Segment]> {
    let size: usize = segments.iter().map(|segment| segment.bytes.len()).sum();
    let mut stretches = Vec::with_capacity(most);
    let (mut first, mut behind) = (0, 0);
    for (i, segment) in segments.iter().enumerate() {
        behind += segment.bytes.len();
        let full = (size as u128 * (stretches.len() as u128 + 1) / most as u128) as usize;
        if behind >= full || i + 1 == segments.len() {
            stretches.push(&segments[first..=i]);
            first = i + 1;
        }
    }
    if stretches.is_empty() {
        stretches.push(segments);
    }
    stretches
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_begin_with_statements() {
        let text = b"v 1\nv 2 \\\n 3\r\nf \\ \r\n 4\r#\nend";
        // Every position where one may begin: after line ends that are not joined to the next line.
        let allowed = [0, 4, 14, 23, 25];
        for most in 1..40 {
            let pieces = split(text, most);
            assert!(pieces.len() <= most);
            assert_eq!((pieces[0].start, pieces[pieces.len() - 1].end), (0, text.len()));
            for pair in pieces.windows(2) {
                assert_eq!(pair[0].end, pair[1].start);
            }
            for piece in &pieces {
                assert!(allowed.contains(&piece.start) && !piece.is_empty(), "{most}: {pieces:?}");
            }
        }
        assert_eq!(split(text, 100).len(), allowed.len());
        let whole = |text: &[u8], most| split(text, most) == vec![std::ops::Range { start: 0, end: text.len() }];
        assert!(whole(b"", 5) && whole(&[b'1'; 1000], 5) && whole(b"1\n", 2));
    }

    #[test]
    fn stretches_hold_every_segment_once() {
        let segment =
            |start: usize, size: usize| Segment { bytes: start..start + size, line: 1, counts: [0; 3], triangles: 1 };
        let segments: Vec<Segment> = (0..10).map(|i| segment(100 * i, 10 + i)).collect();
        for most in 1..15 {
            let stretches = stretches(&segments, most);
            assert!(stretches.len() <= most && stretches.iter().all(|stretch| !stretch.is_empty()));
            assert_eq!(stretches.concat(), segments);
        }
        assert_eq!(stretches(&[], 3), [&[] as &[Segment]]);
    }
}
