//! Averages normals but keeps creases: only faces at a small angle to the corner's own face are included.

use glam::DVec3;
use std::collections::HashMap;

/// Tolerance for rounding in the squared chord between two unit normals: 0.06 degrees at a crease angle of 0, so that
/// the triangles of a flat polygon stay together, and less than 0.0001 degrees at 90.
const TOLERANCE: f64 = 1e-6;

/// Most faces around a place that are compared pairwise.
const MOST_COMPARED: usize = 64;

/// Most faces around a place whose normals are distinguished exactly; of more, those in one cell are merged.
const MOST_EXACT: usize = 1 << 16;

/// Cells per unit length: normals in a cell differ by less than 1.6 degrees, and the sphere has about 80,000 cells.
const CELLS_PER_UNIT: f64 = 64.0;

/// Most points in a leaf of the tree.
const LEAF: usize = 8;

/// Corners that may be averaged with each other, with the normals and weights of their faces.
pub(super) struct Corners<'a> {
    /// Returns for each corner its set, from 0 to `set_count - 1`; others are flat.
    pub(super) set_of_corner: &'a dyn Fn(usize) -> u32,
    pub(super) set_count: usize,
    /// For each triangle, of length 1 or 0.
    pub(super) face_normals: &'a [DVec3],
    /// For each corner.
    pub(super) weights: &'a [f64],
}

/// Returns for each corner the weighted sum of the face normals in its set that differ from its own face's by at most
/// `angle_rad`, and the sum of their weights. Corners of faces without area get the sum of their whole set; flat ones
/// get 0.
///
/// For a place with k faces this takes k^2 steps up to 64 faces. Beyond that the faces are found with a tree over their
/// normals, in k log k steps if the normals are on a curve, as around the tip of a cone, and at most about k^1.5 for
/// normals in all directions. With more than 65,536 faces around one place, those in directions less than 1.6 degrees
/// apart may be merged.
pub(super) fn sums(corners: &Corners<'_>, angle_rad: f64) -> Vec<(DVec3, f64)> {
    let chord = 2.0 * (0.5 * angle_rad.clamp(0.0, std::f64::consts::PI)).sin();
    let reach = chord * chord + TOLERANCE;
    let mut sums = vec![(DVec3::ZERO, 0.0); corners.weights.len()];
    let (members, ends) = members_of_sets(corners);
    let mut first = 0;
    let mut points: Vec<Point> = Vec::new();
    for end in ends {
        let members = &members[first..end];
        first = end;
        points.clear();
        points.extend(members.iter().map(|&corner| Point {
            normal: corners.face_normals[corner as usize / 3],
            weight: corners.weights[corner as usize],
        }));
        let of_points = sums_of_points(&points, reach);
        for (&corner, sum) in members.iter().zip(of_points) {
            sums[corner as usize] = sum;
        }
    }
    sums
}

/// Returns the corners set by set, in order, and the end of each set.
fn members_of_sets(corners: &Corners<'_>) -> (Vec<u32>, Vec<usize>) {
    let set_of = |corner: usize| {
        let set = (corners.set_of_corner)(corner) as usize;
        (set < corners.set_count).then_some(set)
    };
    let mut ends = vec![0_usize; corners.set_count];
    for set in (0..corners.weights.len()).filter_map(set_of) {
        ends[set] += 1;
    }
    let mut total = 0;
    for end in &mut ends {
        // At first, the start of each set.
        total += std::mem::replace(end, total);
    }
    let mut members = vec![0; total];
    for corner in 0..corners.weights.len() {
        if let Some(set) = set_of(corner) {
            members[ends[set]] = corner as u32;
            ends[set] += 1;
        }
    }
    (members, ends)
}

/// The normal of a face around a place, and its weight.
#[derive(Clone, Copy)]
struct Point {
    normal: DVec3,
    weight: f64,
}

impl Point {
    fn sum(self) -> (DVec3, f64) {
        if self.normal == DVec3::ZERO { (DVec3::ZERO, 0.0) } else { (self.weight * self.normal, self.weight) }
    }
}

fn add(a: (DVec3, f64), b: (DVec3, f64)) -> (DVec3, f64) {
    (a.0 + b.0, a.1 + b.1)
}

/// Returns for each point the sum over those within `reach` (a squared distance).
fn sums_of_points(points: &[Point], reach: f64) -> Vec<(DVec3, f64)> {
    let whole = || points.iter().map(|p| p.sum()).fold((DVec3::ZERO, 0.0), add);
    if points.len() <= MOST_COMPARED {
        let near = |own: &Point| {
            let others = points.iter().filter(|p| p.normal.distance_squared(own.normal) <= reach);
            others.map(|p| p.sum()).fold((DVec3::ZERO, 0.0), add)
        };
        return points.iter().map(|own| if own.normal == DVec3::ZERO { whole() } else { near(own) }).collect();
    }
    if points.len() > MOST_EXACT {
        return sums_of_cells(points, reach);
    }
    let whole = whole();
    let tree = Tree::new(points.iter().copied().filter(|p| p.normal != DVec3::ZERO).collect());
    let of = |own: &Point| if own.normal == DVec3::ZERO { whole } else { tree.sum_near(own.normal, reach) };
    points.iter().map(of).collect()
}

/// Like [`sums_of_points`], with all points of a cell merged.
fn sums_of_cells(points: &[Point], reach: f64) -> Vec<(DVec3, f64)> {
    let mut cell_of_key: HashMap<[i32; 3], usize> = HashMap::new();
    let mut cells: Vec<(DVec3, f64)> = Vec::new();
    let cell_of_point: Vec<usize> = points
        .iter()
        .map(|point| {
            let key = (point.normal * CELLS_PER_UNIT).round().to_array().map(|x| x as i32);
            let cell = *cell_of_key.entry(key).or_insert_with(|| {
                cells.push((DVec3::ZERO, 0.0));
                cells.len() - 1
            });
            cells[cell] = add(cells[cell], point.sum());
            cell
        })
        .collect();
    let whole = cells.iter().copied().fold((DVec3::ZERO, 0.0), add);
    // The mean of a cell is nearly of unit length; its corners contribute their sum.
    let mean = |cell: &(DVec3, f64)| Point { normal: cell.0.normalize_or_zero(), weight: cell.0.length() };
    let weight_of_rest: Vec<Point> = cells.iter().map(mean).collect();
    let tree = Tree::new(weight_of_rest.iter().copied().filter(|p| p.normal != DVec3::ZERO).collect());
    let of = |p: &Point| if p.normal == DVec3::ZERO { whole } else { tree.sum_near(p.normal, reach) };
    let of_cells: Vec<(DVec3, f64)> = weight_of_rest.iter().map(of).collect();
    cell_of_point.into_iter().map(|cell| of_cells[cell]).collect()
}

/// A k-d tree (J. L. Bentley, 1975), each box with the sum of its contents.
struct Tree {
    points: Vec<Point>,
    nodes: Vec<Node>,
}

struct Node {
    min: DVec3,
    max: DVec3,
    sum: (DVec3, f64),
    first: usize,
    end: usize,
    /// The two halves; `None` for a leaf.
    halves: Option<[usize; 2]>,
}

impl Tree {
    fn new(points: Vec<Point>) -> Self {
        let mut tree = Tree { nodes: Vec::new(), points };
        if !tree.points.is_empty() {
            tree.build(0, tree.points.len());
        }
        tree
    }

    /// Builds the node for a range of points, which it sorts; the depth is the logarithm of their number.
    fn build(&mut self, first: usize, end: usize) -> usize {
        let points = &mut self.points[first..end];
        let (mut min, mut max, mut sum) = (points[0].normal, points[0].normal, (DVec3::ZERO, 0.0));
        for point in points.iter() {
            (min, max, sum) = (min.min(point.normal), max.max(point.normal), add(sum, point.sum()));
        }
        let node = self.nodes.len();
        self.nodes.push(Node { min, max, sum, first, end, halves: None });
        if end - first > LEAF && min != max {
            let axis = (max - min).max_position();
            // The other coordinates and the weight make the order independent of the input order of equal points.
            let key = |p: &Point| [p.normal[axis], p.normal.x, p.normal.y, p.normal.z, p.weight];
            let middle = points.len() / 2;
            points.select_nth_unstable_by(middle, |a, b| {
                let (a, b) = (key(a), key(b));
                a.iter().zip(&b).map(|(a, b)| a.total_cmp(b)).find(|o| o.is_ne()).unwrap_or(std::cmp::Ordering::Equal)
            });
            let halves = [self.build(first, first + middle), self.build(first + middle, end)];
            self.nodes[node].halves = Some(halves);
        }
        node
    }

    fn sum_near(&self, center: DVec3, reach: f64) -> (DVec3, f64) {
        if self.nodes.is_empty() { (DVec3::ZERO, 0.0) } else { self.sum_of_node(0, center, reach) }
    }

    fn sum_of_node(&self, node: usize, center: DVec3, reach: f64) -> (DVec3, f64) {
        let node = &self.nodes[node];
        let nearest = center.clamp(node.min, node.max);
        let farthest = (center - node.min).abs().max((center - node.max).abs());
        if nearest.distance_squared(center) > reach {
            return (DVec3::ZERO, 0.0);
        }
        if farthest.length_squared() <= reach {
            return node.sum;
        }
        match node.halves {
            Some([a, b]) => add(self.sum_of_node(a, center, reach), self.sum_of_node(b, center, reach)),
            None => {
                let points = self.points[node.first..node.end].iter();
                let near = points.filter(|p| p.normal.distance_squared(center) <= reach);
                near.map(|p| p.sum()).fold((DVec3::ZERO, 0.0), add)
            }
        }
    }
}
