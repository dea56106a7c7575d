//! Counts of statements, faces and corners in a range of a file.

use super::tallies::Tallies;

/// Counts of statements, faces and corners in a range of a file.
#[derive(Default)]
pub(super) struct Statistics {
    /// Statements that were understood, except for faces.
    pub(super) statements: u64,
    /// Faces by number of corners, the last entry for all larger ones; without those left out.
    pub(super) faces: [u64; MOST_COUNTED + 2],
    /// Faces that were left out.
    pub(super) lost: u64,
    /// Corners of faces with more than three corners.
    pub(super) polygon_corners: u64,
    /// Corners without a texture coordinate or normal, and the first line with one.
    pub(super) without: [(u64, u64); 2],
    /// The first line with an index of a texture coordinate or normal, if the file has none.
    pub(super) without_any: [Option<u64>; 2],
    /// Polygons that cross or touch themselves, and those too large or complex to triangulate well.
    pub(super) cuts: [u64; 2],
    /// Numbers of `o`, `g`, `s`, `usemtl`, `mtllib`.
    pub(super) names: [u64; 5],
    pub(super) tallies: Tallies,
}

impl Statistics {
    /// Statements that were understood, except for attributes.
    pub(super) fn understood(&self) -> u64 {
        self.statements + self.face_count()
    }

    /// Faces, including those left out.
    pub(super) fn face_count(&self) -> u64 {
        self.faces.iter().sum::<u64>() + self.lost
    }

    /// Corners of faces that are drawn.
    pub(super) fn corners(&self) -> u64 {
        3 * self.faces[3] + self.polygon_corners
    }

    /// Adds the counts of the next range.
    pub(super) fn append(&mut self, other: Statistics) {
        fn add<const N: usize>(sums: &mut [u64; N], more: [u64; N]) {
            sums.iter_mut().zip(more).for_each(|(sum, more)| *sum += more);
        }
        self.statements += other.statements;
        self.lost += other.lost;
        self.polygon_corners += other.polygon_corners;
        add(&mut self.faces, other.faces);
        add(&mut self.cuts, other.cuts);
        add(&mut self.names, other.names);
        for (mine, theirs) in self.without.iter_mut().zip(other.without) {
            let first_line = if mine.0 == 0 { theirs.1 } else { mine.1 };
            *mine = (mine.0 + theirs.0, first_line);
        }
        for (mine, theirs) in self.without_any.iter_mut().zip(other.without_any) {
            *mine = mine.or(theirs);
        }
        self.tallies.append(other.tallies);
    }
}

/// Most corners for which faces are counted separately.
pub(super) const MOST_COUNTED: usize = 8;

/// The statements counted in [`Statistics::names`].
pub(super) const NAMES: [&str; 5] = ["o", "g", "s", "usemtl", "mtllib"];
