//! Carries a chart to the plane.
//!
//! A flat chart is projected along its mean normal. Others start from that projection, and then get the least-squares
//! conformal map (B. Lévy, S. Petitjean, N. Ray, J. Maillot, "Least squares conformal maps for automatic texture atlas
//! generation", SIGGRAPH 2002) in the form of a Dirichlet energy minus an area (P. Mullen, Y. Tong, P. Alliez,
//! M. Desbrun, "Spectral conformal parameterization", 2008, equation 2), which keeps angles, and a few rounds of the
//! local/global method (L. Liu, L. Zhang, Y. Xu, C. Gotsman, S. Gortler, "A local/global approach to mesh
//! parameterization", 2008, as rigid as possible), which keeps areas too. Of those that do not overlap themselves,
//! the one with the least distortion is taken.

use crate::faces::{Faces, NONE};
use crate::multigrid::{Multigrid, WeightedEdge, summed_edges};
use crate::solver::{Accuracy, PlaneOperator};
use glam::{DVec2, DVec3};

/// A chart is flat if all normals are within 3 degrees of the mean.
const FLAT_COS: f64 = 0.9986;

/// Rounds of the local/global method.
const RIGID_ROUNDS: usize = 10;

/// Limits on the cotangents of slivers, whose equations would drown all others.
const MOST_COTANGENT: f64 = 50.0;

/// The conformal map of a surface with a border is not unique; the first steps lead to one near the start, and later ones away from it.
const CONFORMAL: Accuracy = Accuracy { of_start: 0.004, of_zero: 0.0, most: 60 };

/// The next round moves the places on anyway.
const RIGID: Accuracy = Accuracy { of_start: 0.1, of_zero: 1e-4, most: 60 };

/// A chart by its own vertex numbers.
pub(crate) struct ChartMesh {
    /// Triangles of the mesh.
    pub triangles: Vec<u32>,
    /// Corners of each triangle, indices into `places`.
    pub corners: Vec<[u32; 3]>,
    /// Places of the mesh, ascending.
    pub places: Vec<u32>,
    /// Edges at the border as (triangle of the chart, k): from corner k to corner k + 1.
    pub border: Vec<(u32, u8)>,
}

impl ChartMesh {
    pub fn new(faces: &Faces, triangles: Vec<u32>, chart_of: impl Fn(u32) -> bool) -> Self {
        let mut places: Vec<u32> = triangles.iter().flat_map(|&t| faces.corners[t as usize]).collect();
        places.sort_unstable();
        places.dedup();
        let local = |place: u32| places.binary_search(&place).unwrap_or(0) as u32;
        let corners: Vec<[u32; 3]> = triangles.iter().map(|&t| faces.corners[t as usize].map(local)).collect();
        let mut border = Vec::new();
        for (i, &t) in triangles.iter().enumerate() {
            for (k, &neighbour) in faces.neighbours[t as usize].iter().enumerate() {
                if neighbour == NONE || !chart_of(neighbour) {
                    border.push((i as u32, k as u8));
                }
            }
        }
        ChartMesh { triangles, corners, places, border }
    }

    /// The vertices of a border edge, in its direction.
    pub fn border_ends(&self, &(triangle, k): &(u32, u8)) -> (u32, u32) {
        let corners = self.corners[triangle as usize];
        (corners[k as usize], corners[(k as usize + 1) % 3])
    }
}

/// Returns the place in the plane of each vertex of a chart, counter-clockwise triangles, with the area of the surface: of
/// the maps that `is_good` accepts the one with the least distortion. `Err` is what `is_good` says about the last one if it
/// accepts none.
pub(crate) fn flatten<E>(
    faces: &Faces,
    chart: &ChartMesh,
    is_good: impl Fn(&[DVec2]) -> Result<(), E>,
) -> Result<Vec<DVec2>, E> {
    let area: f64 = chart.triangles.iter().map(|&t| faces.areas[t as usize]).sum();
    let normals = chart.triangles.iter().map(|&t| faces.areas[t as usize] * faces.normals[t as usize]);
    let axis = normals.sum::<DVec3>().normalize_or(DVec3::Z);
    let flatness = chart.triangles.iter().map(|&t| faces.normals[t as usize].dot(axis)).fold(1.0, f64::min);
    let projected = with_area(chart, project(faces, chart, axis), area);
    if flatness > FLAT_COS {
        return is_good(&projected).map(|()| projected);
    }
    let shapes = Shapes::new(faces, chart);
    let conformal = with_area(chart, shapes.conformal(chart, &projected), area);
    let start = if is_good(&conformal).is_ok() { &conformal } else { &projected };
    let rigid = with_area(chart, shapes.rigid(chart, start), area);
    let mut maps = [rigid, conformal, projected].map(|map| (shapes.distortion(chart, &map), map));
    maps.sort_by(|a, b| a.0.total_cmp(&b.0));
    let [(_, best), (_, second), (_, last)] = maps;
    match [best, second].into_iter().find(|map| is_good(map).is_ok()) {
        Some(map) => Ok(map),
        None => is_good(&last).map(|()| last),
    }
}

fn project(faces: &Faces, chart: &ChartMesh, axis: DVec3) -> Vec<DVec2> {
    let right = axis.any_orthonormal_vector();
    let up = axis.cross(right);
    let origin = chart.places.first().map_or(DVec3::ZERO, |&place| faces.positions[place as usize]);
    let carry = |&place: &u32| {
        let p = faces.positions[place as usize] - origin;
        DVec2::new(p.dot(right), p.dot(up))
    };
    chart.places.iter().map(carry).collect()
}

pub(crate) fn signed_area([a, b, c]: [DVec2; 3]) -> f64 {
    0.5 * (b - a).perp_dot(c - a)
}

/// Scales a chart to an area; leaves one without area alone.
fn with_area(chart: &ChartMesh, mut plane: Vec<DVec2>, area: f64) -> Vec<DVec2> {
    let own: f64 = chart.corners.iter().map(|corners| signed_area(corners.map(|i| plane[i as usize]))).sum();
    let scale = (area / own).sqrt();
    if scale.is_finite() && scale > 0.0 {
        plane.iter_mut().for_each(|p| *p *= scale);
    }
    plane
}

/// Triangles laid flat one by one, and the weights of their edges.
struct Shapes {
    /// Corners of each triangle in a plane of its own.
    flat: Vec<[DVec2; 3]>,
    /// Half the cotangents of the angles opposite to the edges from corner k to corner k + 1.
    weights: Vec<[f64; 3]>,
    /// The sum of weights of each edge.
    edges: Vec<WeightedEdge>,
    inverse: Multigrid,
}

impl Shapes {
    fn new(faces: &Faces, chart: &ChartMesh) -> Self {
        let flat: Vec<[DVec2; 3]> =
            chart.triangles.iter().map(|&t| lay_flat(faces.corner_positions(t as usize))).collect();
        let weights: Vec<[f64; 3]> = flat.iter().map(half_cotangents).collect();
        let of_triangles = chart
            .corners
            .iter()
            .zip(&weights)
            .flat_map(|(corners, weights)| (0..3).map(move |k| (corners[k], corners[(k + 1) % 3], weights[k])));
        let edges = summed_edges(of_triangles);
        let inverse = Multigrid::new(chart.places.len(), &edges);
        Shapes { flat, weights, edges, inverse }
    }

    /// The symmetric Dirichlet energy (J. Smith, S. Schaefer, "Bijective parameterization with free boundaries", 2015): the mean
    /// over the surface of s1² + s2² + 1/s1² + 1/s2² for the singular values of each triangle's map; 4 without distortion,
    /// infinite if a triangle is turned over or collapses.
    fn distortion(&self, chart: &ChartMesh, plane: &[DVec2]) -> f64 {
        let (mut energy, mut area) = (0.0, 0.0);
        for (corners, flat) in chart.corners.iter().zip(&self.flat) {
            let [a, b, c] = corners.map(|i| plane[i as usize]);
            let (length, tip) = (flat[1].x, flat[2]);
            let along = (b - a) / length;
            let across = (c - a - along * tip.x) / tip.y;
            let determinant = along.perp_dot(across);
            if determinant.is_nan() || determinant <= 0.0 {
                return f64::INFINITY;
            }
            let squares = along.length_squared() + across.length_squared();
            energy += length * tip.y * squares * (1.0 + 1.0 / (determinant * determinant));
            area += length * tip.y;
        }
        energy / area
    }

    /// The least-squares conformal map, with the two border vertices farthest apart pinned where they are.
    fn conformal(&self, chart: &ChartMesh, start: &[DVec2]) -> Vec<DVec2> {
        let border: Vec<(u32, u32)> = chart.border.iter().map(|edge| chart.border_ends(edge)).collect();
        let pins = farthest(&border, start);
        let operator = PlaneOperator { edges: &self.edges, inverse: &self.inverse, border, pins };
        let mut plane = start.to_vec();
        operator.solve(&mut plane, &vec![DVec2::ZERO; start.len()], CONFORMAL);
        plane
    }

    /// Rounds of turning each triangle to fit its place, then finding the places that fit the triangles best.
    fn rigid(&self, chart: &ChartMesh, start: &[DVec2]) -> Vec<DVec2> {
        let (border, pins) = (Vec::new(), Vec::new());
        let operator = PlaneOperator { edges: &self.edges, inverse: &self.inverse, border, pins };
        let mut plane = start.to_vec();
        let mut right_side = vec![DVec2::ZERO; start.len()];
        for _ in 0..RIGID_ROUNDS {
            right_side.fill(DVec2::ZERO);
            for ((corners, flat), weights) in chart.corners.iter().zip(&self.flat).zip(&self.weights) {
                let mut turn = DVec2::ZERO;
                for k in 0..3 {
                    let own = flat[k] - flat[(k + 1) % 3];
                    let placed = plane[corners[k] as usize] - plane[corners[(k + 1) % 3] as usize];
                    // The rotation that fits best has the direction of the sum of w conj(own) placed.
                    turn += weights[k] * DVec2::new(own.dot(placed), own.perp_dot(placed));
                }
                let turn = turn.normalize_or(DVec2::X);
                for k in 0..3 {
                    let pull = weights[k] * turn.rotate(flat[k] - flat[(k + 1) % 3]);
                    right_side[corners[k] as usize] += pull;
                    right_side[corners[(k + 1) % 3] as usize] -= pull;
                }
            }
            operator.solve(&mut plane, &right_side, RIGID);
        }
        plane
    }
}

fn lay_flat([a, b, c]: [DVec3; 3]) -> [DVec2; 3] {
    let (right, edge) = ((b - a).normalize_or(DVec3::X), c - a);
    let x = edge.dot(right);
    [DVec2::ZERO, DVec2::new((b - a).length(), 0.0), DVec2::new(x, (edge - x * right).length())]
}

fn half_cotangents(flat: &[DVec2; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| {
        let opposite = flat[(k + 2) % 3];
        let (a, b) = (flat[k] - opposite, flat[(k + 1) % 3] - opposite);
        0.5 * (a.dot(b) / a.perp_dot(b)).clamp(-MOST_COTANGENT, MOST_COTANGENT)
    })
}

/// The two vertices of the border that are farthest apart, roughly: far from the first, and far from that.
fn farthest(border: &[(u32, u32)], plane: &[DVec2]) -> Vec<u32> {
    let far_from = |from: u32| {
        let distance = |i: u32| plane[i as usize].distance_squared(plane[from as usize]);
        border.iter().map(|edge| edge.0).max_by(|&a, &b| distance(a).total_cmp(&distance(b)).then(b.cmp(&a)))
    };
    let Some(&(first, _)) = border.first() else { return vec![0] };
    let one = far_from(first).unwrap_or(first);
    let other = far_from(one).unwrap_or(first);
    vec![one, other]
}
