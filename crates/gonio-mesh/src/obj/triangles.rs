//! Triangles as they are made: where they will stay, as far as there is room.

use super::attributes::Segment;

/// Triangles of a stretch of a file.
pub(super) struct Triangles<'a> {
    /// Room in the array of all triangles.
    room: &'a mut [u32],
    /// How much of it is used.
    used: usize,
    /// What found no room.
    more: Vec<u32>,
}

impl<'a> Triangles<'a> {
    /// Alone in the file.
    pub(super) fn of_all(likely: usize) -> Self {
        Triangles { room: &mut [], used: 0, more: Vec::with_capacity(3 * likely) }
    }

    /// Those of one stretch of many.
    pub(super) fn with_room(room: &'a mut [u32]) -> Self {
        Triangles { room, used: 0, more: Vec::new() }
    }

    /// The vertices of one more.
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

    /// How many there are.
    pub(super) fn count(&self) -> usize {
        (self.used + self.more.len()) / 3
    }

    /// All vertices, in order.
    pub(super) fn vertices_mut(&mut self) -> impl Iterator<Item = &mut u32> {
        self.room[..self.used].iter_mut().chain(&mut self.more)
    }

    /// How much of the room is used, and what found none.
    pub(super) fn finish(self) -> (usize, Vec<u32>) {
        (self.used, self.more)
    }
}

/// How many triangles a stretch will probably have.
///
/// Not more than a file of this size may have of triangles with an index of one digit: a file of blanks shall not
/// take more memory than it has itself. Polygons of such indices find room elsewhere.
pub(super) fn likely_count(segments: &[Segment]) -> usize {
    const SMALLEST: usize = "f 1 2 3\n".len();
    segments.iter().map(|segment| segment.triangles.min(segment.bytes.len() / SMALLEST)).sum()
}

/// Gives each stretch its part of the array.
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

/// Closes the gaps between the parts that are used. `parts` are what [`Triangles::finish`] gave, in order.
pub(super) fn join(mut all: Vec<u32>, stretches: &[&[Segment]], mut parts: Vec<(usize, Vec<u32>)>) -> Vec<u32> {
    if let ([_], 0) = (parts.as_slice(), all.len())
        && let Some((_, mut only)) = parts.pop()
    {
        only.shrink_to_fit();
        return only;
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
