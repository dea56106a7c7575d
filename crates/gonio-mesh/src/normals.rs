//! Normals: one per triangle, or averaged over the faces around a corner.

use crate::weld::{self, Table, mix};
use crate::{Diagnostic, Mesh, NormalSource};
use glam::{DVec3, Vec3};
use std::collections::HashMap;

/// A sum of unit vectors is considered zero if they cancel to this fraction of their weights.
const CANCELLED: f64 = 1e-6;

/// Selects the faces that are averaged.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Averaging {
    /// The crease angle, in radians from 0 to pi: a corner's normal is the mean over those faces around it whose
    /// normals differ by at most this angle from the normal of **the corner's own face**. Corners at one position and
    /// in one smoothing group may thus have different normals, and their vertex is split. Faces are only compared with
    /// the corner's own face, not with one another, so a chain of small angles does not connect faces.
    ///
    /// 0 averages only flat surfaces (to 0.06 degrees); 90 degrees averages at the edges of a cube, and less does not.
    /// `None`, or pi and more: all faces.
    pub crease_angle_rad: Option<f64>,
}

impl Averaging {
    /// Returns the angle, if it separates any faces.
    fn crease(&self) -> Option<f64> {
        self.crease_angle_rad.filter(|angle| *angle < std::f64::consts::PI)
    }
}

/// Makes one normal per triangle: every triangle gets three vertices of its own. Degenerate triangles get the normal
/// (0, 0, 0), which the equation replaces by the view direction.
pub fn make_flat(mesh: &Mesh) -> Mesh {
    Mesh { tangents: Vec::new(), normal_source: NormalSource::Flat, ..with_face_normals(mesh) }
}

/// The same with the tangents of the mesh, as flat shading draws it.
pub fn with_face_normals(mesh: &Mesh) -> Mesh {
    let of_face = |triangle| [face_normal(mesh, triangle).as_vec3().to_array(); 3];
    Mesh { normals: (0..mesh.triangle_count()).flat_map(of_face).collect(), ..mesh.unshared() }
}

/// Averages normals over adjacent faces, weighted by angle, within smoothing groups.
///
/// n = normalize(sum over the corners at the same position of angle * face normal), with the weights of G. Thürmer and
/// C. A. Wüthrich (1998, "Computing vertex normals from polygonal facets"): the result does not depend on how polygons
/// are triangulated.
///
/// Faces are adjacent if they share a position (bit by bit), regardless of seams in texture coordinates. If the mesh
/// has smoothing groups, only faces of the same group are averaged, and faces of group 0 are flat. If it has none, or
/// all are 0 (so that averaging would change nothing, although it was requested), all faces are averaged. Vertices are
/// split where needed. Faces without area are ignored. Where faces cancel each other (the two sides of a leaf), each
/// keeps its own normal; corners of faces without area that have no other neighbour get (0, 0, 0), which a diagnostic
/// counts.
pub fn make_averaged(mesh: &Mesh) -> (Mesh, Vec<Diagnostic>) {
    make_averaged_with(mesh, &Averaging::default())
}

/// Like [`make_averaged`], with the creases of `averaging`.
pub fn make_averaged_with(mesh: &Mesh, averaging: &Averaging) -> (Mesh, Vec<Diagnostic>) {
    let groups = if has_smooth_faces(mesh) { mesh.smoothing_groups.as_slice() } else { &[] };
    let normals = averaged_corner_normals(mesh, groups, averaging);
    let diagnostics = report_zero(&normals);
    (with_corner_normals(mesh, &normals, NormalSource::Averaged), diagnostics)
}

fn has_smooth_faces(mesh: &Mesh) -> bool {
    mesh.smoothing_groups.iter().any(|group| *group != 0)
}

/// Adds normals to a mesh that has none, or that lacks some (of length 0): averaged, or flat if the smoothing groups
/// say so.
pub fn complete(mesh: Mesh) -> (Mesh, Vec<Diagnostic>) {
    complete_with(mesh, &Averaging::default())
}

/// Like [`complete`], with the creases of `averaging`.
pub fn complete_with(mesh: Mesh, averaging: &Averaging) -> (Mesh, Vec<Diagnostic>) {
    if mesh.normals.is_empty() && !mesh.smoothing_groups.is_empty() && !has_smooth_faces(&mesh) {
        let note = Diagnostic::note("there are no normals, and smoothing is off: the triangles are flat");
        return (make_flat(&mesh), vec![note]);
    }
    if mesh.normals.is_empty() {
        let (averaged, mut diagnostics) = make_averaged_with(&mesh, averaging);
        let how = if mesh.smoothing_groups.is_empty() { "" } else { " within smoothing groups" };
        diagnostics.insert(0, Diagnostic::note(format!("there are no normals: they are averaged{how}")));
        return (averaged, diagnostics);
    }
    let lacks = |&vertex: &u32| mesh.normals[vertex as usize] == [0.0; 3];
    let lacking = mesh.indices.iter().filter(|vertex| lacks(vertex)).count();
    if lacking == 0 {
        return (mesh, Vec::new());
    }
    let mut normals = averaged_corner_normals(&mesh, &mesh.smoothing_groups, averaging);
    for (normal, vertex) in normals.iter_mut().zip(&mesh.indices) {
        if !lacks(vertex) {
            *normal = mesh.normals[*vertex as usize];
        }
    }
    let mut diagnostics = report_zero(&normals);
    let message = format!("{lacking} of {} corners have no normal: using averaged normals", mesh.indices.len());
    diagnostics.insert(0, Diagnostic::note(message));
    (with_corner_normals(&mesh, &normals, NormalSource::FileAndAveraged), diagnostics)
}

/// Returns the triangle's unit normal, or 0 if it has no area.
fn face_normal(mesh: &Mesh, t: usize) -> DVec3 {
    let [a, b, c] = corner_positions(mesh, t);
    unit_cross(b - a, c - a)
}

fn corner_positions(mesh: &Mesh, t: usize) -> [DVec3; 3] {
    mesh.triangle_positions(t).map(|p: Vec3| p.as_dvec3())
}

/// Returns the unit vector along `a` x `b`, or 0. The product of `f32` differences neither overflows nor vanishes in
/// `f64`.
fn unit_cross(a: DVec3, b: DVec3) -> DVec3 {
    let cross = a.cross(b);
    // A smaller product is only the rounding error of parallel vectors.
    let is_degenerate = cross.length_squared() <= 1e-28 * a.length_squared() * b.length_squared();
    if is_degenerate { DVec3::ZERO } else { cross / cross.length() }
}

/// Returns the angle between two edges of a triangle, from their cross and dot products: also exact near 0 and pi.
fn angle(a: DVec3, b: DVec3) -> f64 {
    a.cross(b).length().atan2(a.dot(b))
}

/// Returns the averaged normal of each corner (index into `indices`), or 0. Without `groups` all faces are averaged.
fn averaged_corner_normals(mesh: &Mesh, groups: &[u32], averaging: &Averaging) -> Vec<[f32; 3]> {
    let (place_of_vertex, place_count) = weld::places(&mesh.positions);
    let sums_of_corners = sums_of_corners(mesh, groups, &place_of_vertex);
    let sum_count = sums_of_corners.as_ref().map_or(place_count, |(_, count)| *count);
    let sum_of = |corner: usize| match &sums_of_corners {
        Some((sum_of_corner, _)) => sum_of_corner[corner],
        None => place_of_vertex[mesh.indices[corner] as usize],
    };
    let own = |corner: usize| face_normal(mesh, corner / 3).as_vec3().to_array();
    // A sum of 0 means that the corner is flat, or that its neighbours cancel each other.
    let or_own = |corner: usize, mean: [f32; 3]| if mean == [0.0; 3] { own(corner) } else { mean };
    if let Some(angle) = averaging.crease() {
        let triangles = mesh.triangle_count();
        let (mut face_normals, mut weights) = (Vec::with_capacity(triangles), Vec::with_capacity(3 * triangles));
        for t in 0..triangles {
            let (normal, angles) = normal_and_angles(mesh, t);
            face_normals.push(normal);
            weights.extend(angles);
        }
        let corners =
            Corners { set_of_corner: &sum_of, set_count: sum_count, face_normals: &face_normals, weights: &weights };
        let sums = sums(&corners, angle);
        return sums.into_iter().enumerate().map(|(corner, sum)| or_own(corner, mean(sum))).collect();
    }
    // The weighted normals, and the weights.
    let mut sums = vec![(DVec3::ZERO, 0.0_f64); sum_count];
    for t in 0..mesh.triangle_count() {
        let (normal, angles) = normal_and_angles(mesh, t);
        if normal == DVec3::ZERO {
            continue;
        }
        for (k, weight) in angles.into_iter().enumerate() {
            if let Some(sum) = sums.get_mut(sum_of(3 * t + k) as usize) {
                sum.0 += weight * normal;
                sum.1 += weight;
            }
        }
    }
    let means: Vec<[f32; 3]> = sums.into_iter().map(mean).collect();
    let mean_of = |corner: usize| means.get(sum_of(corner) as usize).copied().unwrap_or_default();
    (0..mesh.indices.len()).map(|corner| or_own(corner, mean_of(corner))).collect()
}

/// Returns the unit vector along a weighted sum, or 0 if it cancels.
fn mean((sum, weight): (DVec3, f64)) -> [f32; 3] {
    let length = sum.length();
    if length > CANCELLED * weight { (sum / length).as_vec3().to_array() } else { [0.0; 3] }
}

/// Returns a triangle's unit normal and its three angles; 0 if it has no area.
fn normal_and_angles(mesh: &Mesh, t: usize) -> (DVec3, [f64; 3]) {
    let [a, b, c] = corner_positions(mesh, t);
    let normal = unit_cross(b - a, c - a);
    if normal == DVec3::ZERO {
        return (normal, [0.0; 3]);
    }
    // The angles add up to pi.
    let (at_a, at_b) = (angle(b - a, c - a), angle(c - b, a - b));
    (normal, [at_a, at_b, std::f64::consts::PI - at_a - at_b])
}

/// With smoothing groups: returns for each corner the index of its sum, one for each pair of place and group, and the
/// number of sums. `u32::MAX` means none: group 0.
fn sums_of_corners(mesh: &Mesh, groups: &[u32], place_of_vertex: &[u32]) -> Option<(Vec<u32>, usize)> {
    if groups.is_empty() {
        return None;
    }
    let mut table = Table::with_room_for(mesh.indices.len());
    let mut pairs: Vec<(u32, u32)> = Vec::new();
    let mut sum_of_corner = Vec::with_capacity(mesh.indices.len());
    for (corner, &vertex) in mesh.indices.iter().enumerate() {
        let group = groups.get(corner / 3).copied().unwrap_or(0);
        if group == 0 {
            sum_of_corner.push(u32::MAX);
            continue;
        }
        let pair = (place_of_vertex[vertex as usize], group);
        let hash = mix(u64::from(pair.0) | u64::from(pair.1) << 32);
        sum_of_corner.push(table.find(hash, |sum| pairs[sum as usize] == pair).unwrap_or_else(|slot| {
            let sum = pairs.len() as u32;
            table.fill(slot, sum);
            pairs.push(pair);
            sum
        }));
    }
    Some((sum_of_corner, pairs.len()))
}

fn with_corner_normals(mesh: &Mesh, normals: &[[f32; 3]], source: NormalSource) -> Mesh {
    let bare = Mesh { normals: Vec::new(), tangents: Vec::new(), ..mesh.clone() };
    let (mut split, normals) = weld::split_by_corner_values(&bare, normals);
    split.normals = normals;
    split.normal_source = source;
    split
}

fn report_zero(normals: &[[f32; 3]]) -> Vec<Diagnostic> {
    let zero = normals.iter().filter(|normal| **normal == [0.0; 3]).count();
    if zero == 0 {
        return Vec::new();
    }
    vec![Diagnostic::warning(format!(
        "{zero} of {} corners belong to triangles without area and have no normal",
        normals.len()
    ))]
}

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
struct Corners<'a> {
    /// Returns for each corner its set, from 0 to `set_count - 1`; others are flat.
    set_of_corner: &'a dyn Fn(usize) -> u32,
    set_count: usize,
    /// For each triangle, of length 1 or 0.
    face_normals: &'a [DVec3],
    /// For each corner.
    weights: &'a [f64],
}

/// Returns for each corner the weighted sum of the face normals in its set that differ from its own face's by at most
/// `angle_rad`, and the sum of their weights. Corners of faces without area get the sum of their whole set; flat ones
/// get 0.
///
/// For a place with k faces this takes k^2 steps up to 64 faces. Beyond that the faces are found with a tree over their
/// normals, in k log k steps if the normals are on a curve, as around the tip of a cone, and at most about k^1.5 for
/// normals in all directions. With more than 65,536 faces around one place, those in directions less than 1.6 degrees
/// apart may be merged.
fn sums(corners: &Corners<'_>, angle_rad: f64) -> Vec<(DVec3, f64)> {
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
