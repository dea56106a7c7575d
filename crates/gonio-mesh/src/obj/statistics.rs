//! What a stretch of a file says, in numbers.

use super::tallies::Tallies;

/// Numbers of things in a stretch of a file.
#[derive(Default)]
pub(super) struct Statistics {
    /// Statements that were understood, faces apart.
    pub(super) statements: u64,
    /// Faces by number of corners, the last for all larger ones; those left out are not in it.
    pub(super) faces: [u64; MOST_COUNTED + 2],
    /// Faces left out.
    pub(super) lost: u64,
    /// Corners of faces with more than three.
    pub(super) polygon_corners: u64,
    /// Corners without texture coordinate, or normal; and the first line with one.
    pub(super) without: [(u64, u64); 2],
    /// The first line with an index of a texture coordinate, or normal, where there is none at all.
    pub(super) without_any: [Option<u64>; 2],
    /// Polygons that cross or touch themselves, and those too large or winding to be cut well.
    pub(super) cuts: [u64; 2],
    /// How often `o`, `g`, `s`, `usemtl`, `mtllib`.
    pub(super) names: [u64; 5],
    pub(super) tallies: Tallies,
}

impl Statistics {
    /// Statements that were understood, attributes apart.
    pub(super) fn understood(&self) -> u64 {
        self.statements + self.face_count()
    }

    /// Faces, those left out too.
    pub(super) fn face_count(&self) -> u64 {
        self.faces.iter().sum::<u64>() + self.lost
    }

    /// Corners of faces that are drawn.
    pub(super) fn corners(&self) -> u64 {
        3 * self.faces[3] + self.polygon_corners
    }

    /// With those of the stretch that follows.
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

/// Corners up to which faces are counted apart.
pub(super) const MOST_COUNTED: usize = 8;

/// The statements counted in [`Statistics::names`].
pub(super) const NAMES: [&str; 5] = ["o", "g", "s", "usemtl", "mtllib"];
