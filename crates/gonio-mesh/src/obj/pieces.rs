//! Splits a file for several threads, and joins the pieces in file order. The number of pieces does not change the result.

use super::attributes::{Attributes, Segment};
use super::triangles::Triangles;
use super::vertices::{Corner, CornerAttributes, Vertices};
use crate::ReadError;
use gonio_threads::HAS_THREADS;
use gonio_threads::prelude::*;
use std::mem;
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
        let threads = if most < 2 { 1 } else { gonio_threads::current_num_threads() };
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

/// Joins the attributes of consecutive pieces, up to the first error.
pub(super) fn attributes(mut pieces: Vec<Attributes>) -> Attributes {
    let first_error = pieces.iter().position(|piece| piece.error.is_some());
    pieces.truncate(first_error.map_or(pieces.len(), |piece| piece + 1));
    if pieces.len() == 1
        && let Some(piece) = pieces.pop()
    {
        return piece;
    }
    let mut all = Attributes::default();
    let mut counts = [0; 3];
    for piece in &mut pieces {
        for mut segment in mem::take(&mut piece.segments) {
            segment.line += all.lines;
            (0..3).for_each(|kind| segment.counts[kind] += counts[kind]);
            all.segments.push(segment);
        }
        if !piece.colors.is_empty() {
            all.colors.resize(counts[0] as usize, [1.0; 3]);
            all.colors.append(&mut piece.colors);
        }
        let more = piece.counts();
        (0..3).for_each(|kind| counts[kind] += more[kind]);
        all.reports.append(mem::take(&mut piece.reports), all.lines);
        all.colored += piece.colored;
        all.weighted = all.weighted.or(piece.weighted.map(|line| all.lines + line));
        all.error = piece.error.take().map(|error| ReadError { place: error.place.moved_by(all.lines), ..error });
        all.lines += piece.lines;
    }
    // One kind after the other, so that little is in memory twice.
    all.positions = concatenate(pieces.iter_mut().map(|piece| mem::take(&mut piece.positions)).collect());
    all.tex_coords = concatenate(pieces.iter_mut().map(|piece| mem::take(&mut piece.tex_coords)).collect());
    all.normals = concatenate(pieces.iter_mut().map(|piece| mem::take(&mut piece.normals)).collect());
    all
}

fn concatenate<const N: usize>(parts: Vec<Vec<[f32; N]>>) -> Vec<[f32; N]> {
    let mut all = vec![[0.0; N]; parts.iter().map(Vec::len).sum()];
    let mut rest = all.as_mut_slice();
    let mut places = Vec::with_capacity(parts.len());
    for part in parts {
        let (place, behind) = rest.split_at_mut(part.len());
        places.push((place, part));
        rest = behind;
    }
    places.into_par_iter().for_each(|(place, part)| place.copy_from_slice(&part));
    all
}

/// Renumbers the vertices and triangles of consecutive ranges as if all their corners had been looked up in one table,
/// in order.
pub(super) fn vertices(stretches: &mut [(Vertices, Triangles<'_>)]) -> Result<Vertices, ReadError> {
    let Some(((first, _), rest)) = stretches.split_first_mut() else { return Ok(Vertices::new(0)) };
    let mut all = mem::take(first);
    if !HAS_THREADS {
        return Ok(all);
    }
    let mut rest: Vec<Stretch<'_, '_>> = rest.iter_mut().map(Stretch::new).collect();
    let shared = first_attributes(&mut all, &mut rest);
    if rest.iter().all(|stretch| !stretch.differs && stretch.vertices.extras.corners.is_empty()) {
        return Ok(all);
    }
    rest.par_iter_mut().for_each(|stretch| stretch.find_extras(&all));
    let position_count = all.position_count();
    let mut vertices_of_extras = Vec::with_capacity(rest.len());
    for stretch in &mut rest {
        let numbers = mem::take(&mut stretch.found).into_iter().map(|corner| {
            let is_shared = shared[corner.0 as usize / 64] >> (corner.0 % 64) & 1 != 0;
            let extras = &mut all.extras;
            if is_shared { extras.number_of(corner, position_count) } else { extras.push(corner) }
        });
        vertices_of_extras.push(numbers.map(|number| position_count as u64 + u64::from(number)).collect::<Vec<u64>>());
    }
    if (position_count + all.extras.corners.len()) as u64 >= u64::from(u32::MAX) {
        return Err(crate::input::too_many_vertices(u64::from(u32::MAX)));
    }
    rest.par_iter_mut().zip(&vertices_of_extras).for_each(|(stretch, vertices)| stretch.renumber(vertices));
    Ok(all)
}

/// Finds the first attributes of each position in file order. Returns the positions that several ranges use.
fn first_attributes(all: &mut Vertices, rest: &mut [Stretch<'_, '_>]) -> Vec<u64> {
    let mut shared = vec![0; all.position_count() / 64 + 1];
    for stretch in rest {
        for position in stretch.vertices.touched() {
            let kind = stretch.vertices.first(position);
            if !kind.is_used() {
                continue;
            }
            let known = all.first(position);
            if known.is_used() {
                shared[position / 64] |= 1 << (position % 64);
                stretch.differs |= known != kind;
            } else {
                all.set_first(position, kind);
            }
        }
    }
    shared
}

/// A range whose vertices are to be merged with those of the others.
struct Stretch<'a, 'b> {
    vertices: Vertices,
    triangles: &'a mut Triangles<'b>,
    /// Whether the first attributes of some position are not the first ones in the whole file.
    differs: bool,
    /// Its own extra vertices.
    extras: Vec<Corner>,
    /// Corners that are extra vertices of the whole file, in the order of first use.
    found: Vec<Corner>,
    /// For each of its extra vertices the index in `found`, or that it has the first attributes of its position.
    number_of_extra: Vec<ExtraIs>,
}

#[derive(Clone, Copy)]
enum ExtraIs {
    NotSeen,
    First,
    Found(u32),
}

impl<'a, 'b> Stretch<'a, 'b> {
    fn new((vertices, triangles): &'a mut (Vertices, Triangles<'b>)) -> Self {
        let vertices = mem::take(vertices);
        Stretch {
            vertices,
            triangles,
            differs: false,
            extras: Vec::new(),
            found: Vec::new(),
            number_of_extra: Vec::new(),
        }
    }

    /// Finds the corners that are extra vertices of the whole file, in order. First attributes that become an extra
    /// vertex are replaced by its index.
    fn find_extras(&mut self, all: &Vertices) {
        let position_count = self.vertices.position_count();
        let extras = mem::take(&mut self.vertices.extras).into_corners();
        if !self.differs {
            self.number_of_extra = (0..extras.len() as u32).map(ExtraIs::Found).collect();
            self.found = extras;
            return;
        }
        self.number_of_extra = vec![ExtraIs::NotSeen; extras.len()];
        for &mut index in self.triangles.vertices_mut() {
            let vertex = index as usize;
            if let Some(extra) = vertex.checked_sub(position_count) {
                if matches!(self.number_of_extra[extra], ExtraIs::NotSeen) {
                    let corner = extras[extra];
                    self.number_of_extra[extra] = if all.first(corner.0 as usize) == corner.1 {
                        ExtraIs::First
                    } else {
                        self.found.push(corner);
                        ExtraIs::Found(self.found.len() as u32 - 1)
                    };
                }
                continue;
            }
            let kind = self.vertices.first(vertex);
            if kind.is_used() && kind != all.first(vertex) {
                self.vertices.set_first(vertex, CornerAttributes::number(self.found.len() as u32));
                self.found.push((index, kind));
            }
        }
        self.extras = extras;
    }

    /// Renumbers the triangles for the whole file.
    fn renumber(&mut self, vertices_of_found: &[u64]) {
        let position_count = self.vertices.position_count();
        for index in self.triangles.vertices_mut() {
            let vertex = *index as usize;
            let place = match vertex.checked_sub(position_count) {
                Some(extra) => match self.number_of_extra[extra] {
                    ExtraIs::Found(place) => Some(place),
                    ExtraIs::First | ExtraIs::NotSeen => {
                        *index = self.extras[extra].0;
                        None
                    }
                },
                None if self.differs => self.vertices.first(vertex).as_number(),
                None => None,
            };
            if let Some(place) = place {
                *index = vertices_of_found[place as usize] as u32;
            }
        }
    }
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
