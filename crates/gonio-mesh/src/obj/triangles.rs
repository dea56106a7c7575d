//! Collects triangles in their final place, as long as there is room.

use super::attributes::Segment;
use gonio_threads::HAS_THREADS;

/// Triangles of a range of a file.
pub(super) struct Triangles<'a> {
    /// Room in the array of all triangles.
    room: &'a mut [u32],
    /// The used part of it.
    used: usize,
    /// Indices that did not fit.
    more: Vec<u32>,
}

impl<'a> Triangles<'a> {
    /// Creates a list without room in a shared array.
    pub(super) fn of_all(likely: usize) -> Self {
        Triangles { room: &mut [], used: 0, more: Vec::with_capacity(3 * likely) }
    }

    /// Creates the list of one of many ranges.
    pub(super) fn with_room(room: &'a mut [u32]) -> Self {
        Triangles { room, used: 0, more: Vec::new() }
    }

    #[inline(always)]
    pub(super) fn push(&mut self, triangle: [u32; 3]) {
        match self.room.get_mut(self.used..).and_then(|room| room.first_chunk_mut()) {
            Some(room) => {
                *room = triangle;
                self.used += 3;
            }
            None => self.more.extend_from_slice(&triangle),
        }
    }

    /// Returns the number of triangles.
    pub(super) fn count(&self) -> usize {
        (self.used + self.more.len()) / 3
    }

    /// Returns all vertices in order.
    pub(super) fn vertices_mut(&mut self) -> impl Iterator<Item = &mut u32> {
        self.room[..self.used].iter_mut().chain(&mut self.more)
    }

    /// Returns the used part of the room, and the indices that did not fit.
    pub(super) fn finish(self) -> (usize, Vec<u32>) {
        (self.used, self.more)
    }
}

/// Estimates the number of triangles of segments.
///
/// It is at most the number of triangles with one-digit indices that fit into a file of this size, so that a file of
/// blanks does not take more memory than its own size. Polygons with such indices are stored elsewhere.
pub(super) fn likely_count(segments: &[Segment]) -> usize {
    const SMALLEST: usize = "f 1 2 3\n".len();
    segments.iter().map(|segment| segment.triangles.min(segment.bytes.len() / SMALLEST)).sum()
}

/// Divides the array among the ranges.
pub(super) fn rooms<'a>(all: &'a mut [u32], stretches: &[&[Segment]]) -> Vec<Triangles<'a>> {
    let mut rest = all;
    let mut rooms = Vec::with_capacity(stretches.len());
    for stretch in stretches {
        let (room, behind) = rest.split_at_mut((3 * likely_count(stretch)).min(rest.len()));
        rooms.push(Triangles::with_room(room));
        rest = behind;
    }
    rooms
}

/// Closes the gaps between the used parts. `parts` are the results of [`Triangles::finish`], in order.
pub(super) fn join(mut all: Vec<u32>, stretches: &[&[Segment]], mut parts: Vec<(usize, Vec<u32>)>) -> Vec<u32> {
    if (!HAS_THREADS || matches!((parts.as_slice(), all.len()), ([_], 0)))
        && let Some((_, mut only)) = parts.pop()
    {
        only.shrink_to_fit();
        return only;
    }
    if !HAS_THREADS {
        return Vec::new();
    }
    let sizes = stretches.iter().map(|stretch| 3 * likely_count(stretch));
    let mut first = 0;
    if parts.iter().all(|(_, more)| more.is_empty()) {
        let mut end = 0;
        for (size, (used, _)) in sizes.zip(parts) {
            if end != first {
                all.copy_within(first..first + used, end);
            }
            end += used;
            first += size;
        }
        all.truncate(end);
        all.shrink_to_fit();
        return all;
    }
    let mut joined = Vec::with_capacity(parts.iter().map(|(used, more)| used + more.len()).sum());
    for (size, (used, more)) in sizes.zip(parts) {
        joined.extend_from_slice(&all[first..first + used]);
        joined.extend(more);
        first += size;
    }
    joined
}
