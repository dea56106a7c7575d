//! The differences that remain between two buffers after matching equal triangles, polygons that are cut differently, and
//! numbers that differ by rounding.

use super::buffer::{Attributes, Vertex};
use super::cut;
use super::expected::Expected;
use super::fit::SubmittedTriangles;
use super::keys::{TOLERANCE, join, triangle};
use std::collections::{HashMap, HashSet};

/// Triangles without a match, by their numbers.
#[derive(Clone, Debug, Default)]
pub(super) struct Left {
    pub(super) expected: Vec<usize>,
    pub(super) given: Vec<usize>,
}

impl Left {
    pub(super) fn is_nothing(&self) -> bool {
        self.expected.is_empty() && self.given.is_empty()
    }
}

/// Compares exactly, apart from the tolerance and the way in which polygons are cut.
pub(super) fn left(
    expected: &Expected,
    triangles: &[[Vertex; 3]],
    given: &SubmittedTriangles,
    compared: Attributes,
) -> Left {
    let left = unequal(expected, given, compared);
    if left.is_nothing() {
        return left;
    }
    let left = other_cuts(expected, given, left, compared);
    loosely(expected, triangles, left, compared, TOLERANCE)
}

fn unequal(expected: &Expected, given: &SubmittedTriangles, compared: Attributes) -> Left {
    let key = |vertices: &[Vertex; 3]| triangle(vertices.map(|vertex| join(expected.keys.vertex(&vertex, compared))));
    let mut by_key: HashMap<u64, Vec<usize>> = HashMap::new();
    for (number, triangle) in expected.triangles.iter().enumerate().rev() {
        by_key.entry(key(&triangle.vertices)).or_default().push(number);
    }
    let mut left = Left::default();
    for (key, number) in &given.keys {
        if by_key.get_mut(key).and_then(Vec::pop).is_none() {
            left.given.push(*number);
        }
    }
    left.expected.extend(by_key.into_values().flatten());
    left.expected.sort_unstable();
    left.given.sort_unstable();
    left
}

/// Removes polygons that the student cut into different triangles that cover them as well.
fn other_cuts(expected: &Expected, given: &SubmittedTriangles, left: Left, compared: Attributes) -> Left {
    struct Polygon {
        positions: Vec<[f32; 3]>,
        corners: HashMap<u64, usize>,
        /// Expected triangles without a match.
        missing: Vec<usize>,
        cut: Vec<[usize; 3]>,
        given: Vec<usize>,
    }
    let mut polygons: HashMap<usize, Polygon> = HashMap::new();
    for number in &left.expected {
        let Some(face) = expected.triangles[*number].face else { continue };
        if expected.source.faces[face].corners.len() > 3 {
            let empty = || Polygon {
                positions: Vec::new(),
                corners: HashMap::new(),
                missing: Vec::new(),
                cut: Vec::new(),
                given: Vec::new(),
            };
            polygons.entry(face).or_insert_with(empty).missing.push(*number);
        }
    }
    // Collects the corners, and the triangles that match.
    let is_left: HashSet<usize> = left.expected.iter().copied().collect();
    let mut place_in_face: HashMap<usize, usize> = HashMap::new();
    for (number, triangle) in expected.triangles.iter().enumerate() {
        let Some(polygon) = triangle.face.and_then(|face| polygons.get_mut(&face)) else { continue };
        let face = triangle.face.unwrap_or_default();
        let source = &expected.source.faces[face];
        let place = place_in_face.entry(face).or_default();
        let Some(cut) = source.cut.get(*place) else { continue };
        *place += 1;
        polygon.positions.resize(source.corners.len(), [f32::NAN; 3]);
        for (corner, vertex) in cut.iter().zip(&triangle.vertices) {
            polygon.positions[*corner] = vertex.position;
            polygon.corners.insert(join(expected.keys.vertex(vertex, compared)), *corner);
        }
        if !is_left.contains(&number) {
            polygon.cut.push(*cut);
        }
    }
    polygons.retain(|_, polygon| polygon.corners.len() == polygon.positions.len());
    let mut faces_of: HashMap<u64, Vec<usize>> = HashMap::new();
    let mut numbers: Vec<usize> = polygons.keys().copied().collect();
    numbers.sort_unstable();
    for face in &numbers {
        polygons[face].corners.keys().for_each(|vertex| faces_of.entry(*vertex).or_default().push(*face));
    }
    let mut taken = vec![false; given.corners.len()];
    for number in &left.given {
        let corners = given.corners[*number].map(join);
        for face in faces_of.get(&corners[0]).into_iter().flatten() {
            let Some(polygon) = polygons.get_mut(face) else { continue };
            let places = corners.map(|vertex| polygon.corners.get(&vertex).copied());
            if let [Some(a), Some(b), Some(c)] = places {
                polygon.cut.push([a, b, c]);
                polygon.given.push(*number);
            }
        }
    }
    let mut found = HashSet::new();
    for face in &numbers {
        let polygon = &polygons[face];
        if cut::covers(&polygon.positions, &polygon.cut) && polygon.given.iter().all(|number| !taken[*number]) {
            polygon.given.iter().for_each(|number| taken[*number] = true);
            found.extend(polygon.missing.iter().copied());
        }
    }
    Left {
        expected: left.expected.into_iter().filter(|number| !found.contains(number)).collect(),
        given: left.given.into_iter().filter(|number| !taken[*number]).collect(),
    }
}

/// Removes pairs whose numbers differ by at most `tolerance`, relative to the model's size (to 1 except for positions).
pub(super) fn loosely(
    expected: &Expected,
    triangles: &[[Vertex; 3]],
    left: Left,
    compared: Attributes,
    tolerance: f64,
) -> Left {
    // A different count cannot become equal.
    if left.expected.len() != left.given.len() {
        return left;
    }
    let reach = tolerance * expected.keys.scale;
    let cell = |vertices: &[Vertex; 3]| {
        let sum = |axis: usize| vertices.iter().map(|vertex| f64::from(vertex.position[axis])).sum::<f64>() / 3.0;
        [0, 1, 2].map(|axis| (sum(axis) / (4.0 * reach)).round() as i64)
    };
    let mut cells: HashMap<[i64; 3], Vec<usize>> = HashMap::new();
    for number in &left.expected {
        cells.entry(cell(&expected.triangles[*number].vertices)).or_default().push(*number);
    }
    let within =
        |a: &[f32], b: &[f32], most: f64| a.iter().zip(b).all(|(a, b)| (f64::from(*a) - f64::from(*b)).abs() <= most);
    let is_like = |a: &Vertex, b: &Vertex| {
        within(&a.position, &b.position, reach)
            && (!compared.tex_coords || within(&a.tex_coord, &b.tex_coord, tolerance))
            && (!compared.normals || within(&a.normal, &b.normal, tolerance))
    };
    let mut still_given = Vec::new();
    for number in left.given {
        let given = &triangles[number];
        let [x, y, z] = cell(given);
        let near = (0..27).map(|i: i64| {
            let step = |axis: i64| i / 3_i64.pow(axis as u32) % 3 - 1;
            [x.saturating_add(step(0)), y.saturating_add(step(1)), z.saturating_add(step(2))]
        });
        let mut is_found = false;
        for near in near {
            let Some(candidates) = cells.get_mut(&near) else { continue };
            let place = candidates.iter().position(|candidate| {
                let other = &expected.triangles[*candidate].vertices;
                (0..3).any(|turn| (0..3).all(|i| is_like(&given[i], &other[(i + turn) % 3])))
            });
            if let Some(place) = place {
                candidates.swap_remove(place);
                is_found = true;
                break;
            }
        }
        if !is_found {
            still_given.push(number);
        }
    }
    let mut still_expected: Vec<usize> = cells.into_values().flatten().collect();
    still_expected.sort_unstable();
    Left { expected: still_expected, given: still_given }
}
