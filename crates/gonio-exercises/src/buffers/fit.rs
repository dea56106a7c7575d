//! Measures how well the buffer of a wrong reader matches the student's.

use super::buffer::{Attributes, Vertex};
use super::keys::{CornerKeys, Keys, join, mix, triangle};
use super::obj_lines::ObjLines;
use super::reader::{Corner, Reader, Triangle};

/// A reader's triangles as keys.
#[derive(Clone, Debug)]
pub(super) struct Triangles {
    /// Keys in ascending order.
    pub(super) keys: Vec<u64>,
    /// Triangles with corners whose values are unknown.
    pub(super) open: Vec<[CornerKeys; 3]>,
    /// A hash that is equal for equal sets of triangles.
    pub(super) print: u64,
}

/// The values that a program may read beyond the end of a list.
#[derive(Clone, Copy)]
enum Behind {
    Zeros,
    NotANumber,
    /// The program checks indices, and leaves the triangle out.
    Nothing,
}

impl Triangles {
    /// The possible results of a reader: first with unknown values for everything read beyond the end of a list; if there is
    /// any, also with the values that usually are there.
    pub(super) fn read(reader: &Reader, source: &ObjLines, keys: &Keys, compared: Attributes) -> Vec<Self> {
        let made = reader.read(source);
        let open = Self::new(&made, keys, compared, None);
        if open.open.is_empty() {
            return vec![open];
        }
        let usual = [Behind::Zeros, Behind::NotANumber, Behind::Nothing];
        let usual = usual.map(|behind| Self::new(&made, keys, compared, Some(behind)));
        [open].into_iter().chain(usual).filter(|made| !made.keys.is_empty()).collect()
    }

    fn new(made: &[Triangle], keys: &Keys, compared: Attributes, behind: Option<Behind>) -> Self {
        let (mut closed, mut open) = (Vec::new(), Vec::new());
        for triangle in made {
            let corners = corner_keys(&filled(triangle, behind), keys, compared);
            match (closed_key(&corners), behind) {
                (Some(key), _) => closed.push(key),
                (None, Some(Behind::Nothing)) => {}
                (None, _) => open.push(corners),
            }
        }
        closed.sort_unstable();
        Triangles { print: print(&closed), keys: closed, open }
    }
}

fn filled(triangle: &Triangle, behind: Option<Behind>) -> Triangle {
    let value = match behind {
        Some(Behind::Zeros) => 0.0,
        Some(Behind::NotANumber) => f32::NAN,
        Some(Behind::Nothing) | None => return *triangle,
    };
    let corners = triangle.corners.map(|corner| Corner {
        position: corner.position.or(Some([value; 3])),
        tex_coord: corner.tex_coord.or(Some([value; 2])),
        normal: corner.normal.or(Some([value; 3])),
    });
    Triangle { corners, ..*triangle }
}

/// The keys of a triangle's corners.
pub(super) fn corner_keys(made: &Triangle, keys: &Keys, compared: Attributes) -> [CornerKeys; 3] {
    made.corners.map(|corner| keys.corner(&corner, compared))
}

/// A triangle's key; `None` if a value of a corner is unknown.
pub(super) fn closed_key(corners: &[CornerKeys; 3]) -> Option<u64> {
    let [a, b, c] = corners.map(|[p, t, n]| Some(join([p?, t?, n?])));
    Some(triangle([a?, b?, c?]))
}

fn print(keys: &[u64]) -> u64 {
    keys.iter().fold(0, |sum: u64, key| sum.wrapping_add(mix(*key)))
}

/// The student's triangles.
pub(super) struct SubmittedTriangles {
    pub(super) corners: Vec<[[u64; 3]; 3]>,
    /// Keys in ascending order, with the triangles' numbers.
    pub(super) keys: Vec<(u64, usize)>,
    pub(super) print: u64,
}

impl SubmittedTriangles {
    pub(super) fn new(triangles: &[[Vertex; 3]], keys: &Keys, compared: Attributes) -> Self {
        let corners: Vec<[[u64; 3]; 3]> =
            triangles.iter().map(|corners| corners.map(|vertex| keys.vertex(&vertex, compared))).collect();
        let mut keys: Vec<(u64, usize)> =
            corners.iter().enumerate().map(|(number, corners)| (triangle(corners.map(join)), number)).collect();
        keys.sort_unstable();
        let print = keys.iter().fold(0, |sum: u64, (key, _)| sum.wrapping_add(mix(*key)));
        SubmittedTriangles { corners, keys, print }
    }
}

/// The quality of a match.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Fit {
    /// Number of triangles in both, divided by the number in either: 1 if they are the same.
    pub(super) share: f64,
    /// Number of matched triangles with unknown values.
    pub(super) open: usize,
}

/// Maximum number of combinations of open triangles and unmatched triangles that are tried.
const MOST_TRIALS: usize = 4_000_000;

/// Compares a reader's triangles with the student's; `None` if the share is below `least`.
pub(super) fn fit(made: &Triangles, given: &SubmittedTriangles, least: f64) -> Option<Fit> {
    let (most, fewest) = (made.keys.len() + made.open.len(), given.keys.len());
    let bound = most.min(fewest) as f64 / made.keys.len().max(fewest).max(1) as f64;
    if bound < least {
        return None;
    }
    let mut left = Vec::new();
    let matched = matches(&made.keys, &given.keys, |number| left.push(number));
    let (mut open, mut known) = (0, 0);
    if made.open.len().saturating_mul(left.len()) <= MOST_TRIALS {
        for corners in &made.open {
            if let Some(place) = left.iter().position(|number| is_like(corners, &given.corners[*number])) {
                left.swap_remove(place);
                open += 1;
                known += known_in(corners);
            }
        }
    }
    let both = matched + open;
    let either = given.keys.len() + made.keys.len() - matched;
    // At least half of all values must be known: unknown values agree with anything.
    let is_enough = 2 * (9 * matched + known) >= 9 * given.keys.len();
    let share = if is_enough { both as f64 / either.max(1) as f64 } else { 0.0 };
    (share >= least).then_some(Fit { share, open })
}

/// Number of keys in both; calls `left` with each of the student's others.
pub(super) fn matches(made: &[u64], given: &[(u64, usize)], mut left: impl FnMut(usize)) -> usize {
    let (mut made, mut matched) = (made.iter().peekable(), 0);
    for (key, number) in given {
        while made.next_if(|other| *other < key).is_some() {}
        if made.next_if(|other| *other == key).is_some() {
            matched += 1;
        } else {
            left(*number);
        }
    }
    matched
}

/// Whether all known values of an open triangle agree with another; more than half must be known.
fn is_like(open: &[CornerKeys; 3], given: &[[u64; 3]; 3]) -> bool {
    let agrees = |(open, given): (&CornerKeys, &[u64; 3])| {
        open.iter().zip(given).all(|(open, given)| open.is_none_or(|open| open == *given))
    };
    known_in(open) >= 5 && (0..3).any(|turn| (0..3).all(|i| agrees((&open[i], &given[(i + turn) % 3]))))
}

/// Number of known values, at most nine: positions, texture coordinates and normals of three corners.
fn known_in(open: &[CornerKeys; 3]) -> usize {
    open.iter().flatten().flatten().count()
}
