//! All ways in which six pictures can lie on a cube, and the search for those whose edges meet.
//!
//! A picture lies on one of six faces, turned by one of four quarters, mirrored or not: 48 placements. There are also
//! 48 symmetries of the cube (24 turns and their mirror images), and each moves a given placement to another one. Edges
//! decide only *up to* these 48: the first picture is therefore kept in its place, and 5! 8^5 = 3.9 million
//! arrangements are left, of which a search that gives up early visits a small part.

use crate::face::Face;
use crate::seams::Seams;
use glam::{DMat3, DVec3};

/// The placement of a file's picture: `8 * face + 4 * mirrored + quarters`. Its columns are mirrored first, then it is
/// turned clockwise.
pub(crate) type Placement = usize;

/// The placement of each of six files.
pub(crate) type Placements = [Placement; 6];

/// The limit on arrangements that fit equally well; with more, the edges decide nothing.
const CROWD: usize = 60_000;

/// Every file on the face with its name, unchanged.
pub(crate) const AS_GIVEN: Placements = [0, 8, 16, 24, 32, 40];

/// Face (index in [`Face::ALL`]), mirrored, clockwise quarter turns.
pub(crate) fn parts(placement: Placement) -> (usize, bool, usize) {
    (placement / 8, placement % 8 >= 4, placement % 4)
}

/// Returns the side of the file at a side of the face (top, right, bottom, left).
fn side_of_file(placement: Placement, side: usize) -> usize {
    let (_, mirrored, quarters) = parts(placement);
    let before_turning = (side + 4 - quarters) % 4;
    if mirrored { (4 - before_turning) % 4 } else { before_turning }
}

/// The cube's geometry.
pub(crate) struct Cube {
    /// The twelve edges: face and side, and the neighbour's.
    pub edges: Vec<(usize, usize, usize, usize)>,
    /// `[symmetry][placement]`: the placement after the symmetry.
    moved: Vec<[Placement; 48]>,
    /// `[from][to]`: the symmetry that moves a placement to another.
    mover: Vec<[usize; 48]>,
    /// Whether a symmetry mirrors the world.
    pub mirrors: [bool; 48],
}

impl Cube {
    pub fn new() -> Self {
        let frames: Vec<DMat3> = (0..48).map(frame).collect();
        let find = |frame: DMat3| frames.iter().position(|f| *f == frame).unwrap_or(0);
        let mut moved = vec![[0; 48]; 48];
        let mut mover = vec![[0; 48]; 48];
        let mut mirrors = [false; 48];
        for symmetry in 0..48 {
            // The one that moves placement 0 to the placement of this number.
            let matrix = frames[symmetry] * frames[0].transpose();
            mirrors[symmetry] = matrix.determinant() < 0.0;
            for from in 0..48 {
                let to = find(matrix * frames[from]);
                moved[symmetry][from] = to;
                mover[from][to] = symmetry;
            }
        }
        Cube { edges: edges(), moved, mover, mirrors }
    }

    /// Moves an arrangement as a whole.
    pub fn moved(&self, symmetry: usize, arrangement: &Placements) -> Placements {
        arrangement.map(|p| self.moved[symmetry][p])
    }

    /// Moves the arrangement so that as many files as possible have the placement of another one.
    pub fn aligned(&self, arrangement: &Placements, other: &Placements) -> Placements {
        // At least one file can be brought to its place, so only six symmetries come into question.
        let candidates = (0..6).map(|f| self.moved(self.mover[arrangement[f]][other[f]], arrangement));
        candidates.min_by_key(|a| differing(a, other)).unwrap_or(*arrangement)
    }

    /// Returns the sum of the misfits of all twelve edges.
    pub fn misfit(&self, seams: &Seams, arrangement: &Placements) -> f64 {
        self.misfits(seams, arrangement).sum()
    }

    /// Returns the misfit of each of the twelve edges.
    pub fn misfits<'a>(&'a self, seams: &'a Seams, arrangement: &Placements) -> impl Iterator<Item = f64> + 'a {
        let mut files = [(0, 0); 6];
        for (file, &placement) in arrangement.iter().enumerate() {
            files[placement / 8] = (file, placement);
        }
        self.edges.iter().map(move |&(a, side_a, b, side_b)| edge_misfit(seams, files[a], side_a, files[b], side_b))
    }

    /// Returns the lowest misfit, and all arrangements (with the first file in its place) whose misfit is at most that
    /// times `1 + relative`, plus `absolute`. The list is `None` if there are too many.
    pub fn search(&self, seams: &Seams, relative: f64, absolute: f64) -> (f64, Option<Vec<Placements>>) {
        let mut search = Search::new(self, seams);
        search.bound = self.misfit(seams, &AS_GIVEN);
        search.narrows = true;
        search.place(1);
        let best = search.bound;
        search.bound = best * (1.0 + relative) + absolute;
        search.narrows = false;
        search.found.clear();
        search.place(1);
        (best, (search.found.len() < CROWD).then_some(search.found))
    }
}

/// Counts the files with different placements in two arrangements.
pub(crate) fn differing(a: &Placements, b: &Placements) -> usize {
    a.iter().zip(b).filter(|(p, q)| p != q).count()
}

fn edge_misfit(
    seams: &Seams,
    (file_a, a): (usize, Placement),
    side_a: usize,
    (file_b, b): (usize, Placement),
    side_b: usize,
) -> f64 {
    let same_way = parts(a).1 != parts(b).1;
    seams.misfit(4 * file_a + side_of_file(a, side_a), 4 * file_b + side_of_file(b, side_b), same_way)
}

/// The face's middle and the directions of the file's columns and rows, in the cube's directions (OpenGL's table).
fn frame(placement: Placement) -> DMat3 {
    let (face, mirrored, quarters) = parts(placement);
    let face = Face::ALL[face];
    let (middle, s, t) = (face.direction(0.0, 0.0, crate::Layout::OpenGl), face.along_s(), face.along_t());
    let put = |mut u: f64, mut v: f64| -> DVec3 {
        if mirrored {
            u = -u;
        }
        for _ in 0..quarters {
            // Clockwise: what was to the right is below.
            (u, v) = (-v, u);
        }
        u * s + v * t
    };
    DMat3::from_cols(middle, put(1.0, 0.0), put(0.0, 1.0))
}

/// Finds the sides that share both of their corners.
fn edges() -> Vec<(usize, usize, usize, usize)> {
    let ends = |face: usize, side: usize| {
        let corner = |k: usize| {
            let (s, t) = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)][k % 4];
            Face::ALL[face].direction(s, t, crate::Layout::OpenGl)
        };
        (corner(side), corner(side + 1))
    };
    let sides = |face: usize| (0..4).map(move |side| (face, side));
    let mut edges = Vec::new();
    for (a, side_a) in (0..6).flat_map(sides) {
        for (b, side_b) in (a + 1..6).flat_map(sides) {
            let (first, last) = ends(a, side_a);
            // All faces are of one hand: going clockwise about either, a shared edge is run through in opposite senses.
            if ends(b, side_b) == (last, first) {
                edges.push((a, side_a, b, side_b));
            }
        }
    }
    edges
}

/// Faces in an order in which each soon has neighbours.
const ORDER: [usize; 6] = [0, 2, 4, 3, 5, 1];

/// A search that puts a file on one face after the other and drops arrangements that already fit too badly.
struct Search<'a> {
    seams: &'a Seams,
    /// Per step: (side, step of the neighbour that is there already, its side).
    meets: [Vec<(usize, usize, usize)>; 6],
    /// File and placement on the faces so far, in [`ORDER`].
    placed: [(usize, Placement); 6],
    used: [bool; 6],
    so_far: f64,
    bound: f64,
    /// Whether each arrangement found lowers the bound.
    narrows: bool,
    found: Vec<Placements>,
}

impl<'a> Search<'a> {
    fn new(cube: &Cube, seams: &'a Seams) -> Self {
        let step = |face: usize| ORDER.iter().position(|&f| f == face).unwrap_or(0);
        let mut meets: [Vec<(usize, usize, usize)>; 6] = Default::default();
        for &(a, side_a, b, side_b) in &cube.edges {
            let (earlier, later) =
                if step(a) < step(b) { ((a, side_a), (b, side_b)) } else { ((b, side_b), (a, side_a)) };
            meets[step(later.0)].push((later.1, step(earlier.0), earlier.1));
        }
        let used = [true, false, false, false, false, false];
        Search {
            seams,
            meets,
            placed: [(0, 0); 6],
            used,
            so_far: 0.0,
            bound: f64::INFINITY,
            narrows: true,
            found: Vec::new(),
        }
    }

    fn place(&mut self, step: usize) {
        if step == ORDER.len() {
            if self.narrows {
                self.bound = self.bound.min(self.so_far);
            } else {
                let mut arrangement = [0; 6];
                self.placed.iter().for_each(|&(file, placement)| arrangement[file] = placement);
                self.found.push(arrangement);
            }
            return;
        }
        for file in 1..6 {
            if self.used[file] {
                continue;
            }
            for way in 0..8 {
                let here = (file, 8 * ORDER[step] + way);
                let misfit: f64 = self.meets[step]
                    .iter()
                    .map(|&(side, other, side_there)| {
                        edge_misfit(self.seams, here, side, self.placed[other], side_there)
                    })
                    .sum();
                let before = self.so_far;
                // While it narrows, what is only as good as the best need not be followed.
                let worth = if self.narrows { before + misfit < self.bound } else { before + misfit <= self.bound };
                if worth && self.found.len() < CROWD {
                    self.placed[step] = here;
                    self.used[file] = true;
                    self.so_far = before + misfit;
                    self.place(step + 1);
                    self.so_far = before;
                    self.used[file] = false;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cube_has_its_edges_and_symmetries() {
        let cube = Cube::new();
        assert_eq!(cube.edges.len(), 12);
        assert_eq!(cube.mirrors.iter().filter(|m| **m).count(), 24);
        for symmetry in 0..48 {
            let mut there = cube.moved[symmetry].to_vec();
            there.sort_unstable();
            assert_eq!(there, (0..48).collect::<Vec<_>>());
            assert_eq!(cube.mover[5][cube.moved[symmetry][5]], symmetry);
        }
        // A quarter turn of the whole cube, and the way back.
        let moved = cube.moved(17, &AS_GIVEN);
        assert_ne!(moved, AS_GIVEN);
        assert_eq!(cube.aligned(&moved, &AS_GIVEN), AS_GIVEN);
    }
}
