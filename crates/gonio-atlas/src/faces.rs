//! Triangles by place: neighbours, normals, areas.

use glam::DVec3;
use gonio_mesh::Mesh;

/// No triangle, no chart.
pub(crate) const NONE: u32 = u32::MAX;

/// A triangle whose area is below this share of its longest edge squared has no usable normal: `f32` positions have
/// seven digits.
const LEAST_SHARE: f64 = 1e-9;

/// The triangles of a mesh, with vertices at the same position joined.
pub(crate) struct Faces {
    /// The places of each triangle's corners.
    pub corners: Vec<[u32; 3]>,
    /// The position of each place.
    pub positions: Vec<DVec3>,
    /// Unit normals; zero for degenerate triangles.
    pub normals: Vec<DVec3>,
    /// Areas; zero for degenerate triangles.
    pub areas: Vec<f64>,
    /// The triangles across the edges from corner k to corner k + 1, [`NONE`] at a border. Only edges of exactly two
    /// triangles that run through them in opposite directions connect.
    pub neighbours: Vec<[u32; 3]>,
}

impl Faces {
    pub fn new(mesh: &Mesh) -> Faces {
        let (place_of_vertex, count) = mesh.places();
        let mut positions = vec![DVec3::ZERO; count];
        for (&place, position) in place_of_vertex.iter().zip(&mesh.positions) {
            positions[place as usize] = DVec3::from(position.map(f64::from));
        }
        let corners: Vec<[u32; 3]> = mesh
            .indices
            .as_chunks::<3>()
            .0
            .iter()
            .map(|triangle| triangle.map(|vertex| place_of_vertex[vertex as usize]))
            .collect();
        let (normals, areas): (Vec<DVec3>, Vec<f64>) =
            corners.iter().map(|corners| normal_and_area(corners, &positions)).unzip();
        let neighbours = neighbours(&corners, &areas, count);
        Faces { corners, positions, normals, areas, neighbours }
    }

    /// Disconnects triangles whose normals differ by more than an angle: a chart bent over a sharp edge would be stretched.
    pub fn cut_sharp_edges(&mut self, limit_cos: f64) {
        let normals = std::mem::take(&mut self.normals);
        self.cut_between(|a, b| normals[a].dot(normals[b]) < limit_cos);
        self.normals = normals;
    }

    /// Disconnects neighbours.
    pub fn cut_between(&mut self, is_cut: impl Fn(usize, usize) -> bool) {
        for (t, neighbours) in self.neighbours.iter_mut().enumerate() {
            for other in neighbours.iter_mut().filter(|other| **other != NONE) {
                if is_cut(t, *other as usize) {
                    *other = NONE;
                }
            }
        }
    }

    pub fn len(&self) -> usize {
        self.corners.len()
    }

    pub fn is_degenerate(&self, triangle: usize) -> bool {
        self.areas[triangle] == 0.0
    }

    pub fn corner_positions(&self, triangle: usize) -> [DVec3; 3] {
        self.corners[triangle].map(|place| self.positions[place as usize])
    }

    /// Length of the edge from corner `k` to corner `k + 1`.
    pub fn edge_length(&self, triangle: usize, k: usize) -> f64 {
        let corners = self.corner_positions(triangle);
        corners[k].distance(corners[(k + 1) % 3])
    }
}

fn normal_and_area(corners: &[u32; 3], positions: &[DVec3]) -> (DVec3, f64) {
    let [a, b, c] = corners.map(|place| positions[place as usize]);
    let cross = (b - a).cross(c - a);
    let longest = (b - a).length_squared().max((c - b).length_squared()).max((a - c).length_squared());
    let area = 0.5 * cross.length();
    if area.is_finite() && area > LEAST_SHARE * longest { (cross.normalize(), area) } else { (DVec3::ZERO, 0.0) }
}

/// Half-edges are grouped by their smaller place, so that a comparison within each small group finds the pairs.
fn neighbours(corners: &[[u32; 3]], areas: &[f64], places: usize) -> Vec<[u32; 3]> {
    let ends = |half: usize| {
        let corners = corners[half / 3];
        (corners[half % 3], corners[(half + 1) % 3])
    };
    let live = |half: &usize| areas[half / 3] > 0.0;
    let mut starts = vec![0_usize; places + 1];
    for half in (0..3 * corners.len()).filter(live) {
        let (from, to) = ends(half);
        starts[from.min(to) as usize + 1] += 1;
    }
    for place in 0..places {
        starts[place + 1] += starts[place];
    }
    let mut fill = starts.clone();
    let mut grouped = vec![0_u32; starts[places]];
    for half in (0..3 * corners.len()).filter(live) {
        let (from, to) = ends(half);
        let slot = &mut fill[from.min(to) as usize];
        grouped[*slot] = half as u32;
        *slot += 1;
    }
    let mut neighbours = vec![[NONE; 3]; corners.len()];
    for place in 0..places {
        let group = &mut grouped[starts[place]..starts[place + 1]];
        let far_end = |half: u32| {
            let (from, to) = ends(half as usize);
            from.max(to)
        };
        group.sort_unstable_by_key(|&half| (far_end(half), half));
        for pair in group.chunk_by(|&a, &b| far_end(a) == far_end(b)) {
            let &[a, b] = pair else { continue };
            let (a, b) = (a as usize, b as usize);
            if ends(a).0 == ends(b).1 && a / 3 != b / 3 {
                neighbours[a / 3][a % 3] = (b / 3) as u32;
                neighbours[b / 3][b % 3] = (a / 3) as u32;
            }
        }
    }
    neighbours
}
