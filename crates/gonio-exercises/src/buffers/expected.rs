//! The buffers that correct and wrong readers make of a model.

use super::buffer::{Attributes, Vertex, unit};
use super::fit::Triangles;
use super::keys::Keys;
use super::mistakes::{self, WrongReader};
use super::obj_lines::ObjLines;
use super::reader::{Reader, Triangle};
use gonio_mesh::{Limits, Mesh, NoSidecars, ReadError};
use std::sync::OnceLock;

/// A model's vertex buffer as gonio-mesh reads it, with everything that comparisons need.
pub struct Expected {
    pub(super) source: ObjLines,
    pub(super) triangles: Vec<ExpectedTriangle>,
    pub(super) has: Attributes,
    pub(super) keys: Keys,
    /// Indexed by [`Attributes::number`] of the compared attributes.
    wrong_buffers: [OnceLock<WrongBuffers>; 4],
}

/// A triangle, and the face that it belongs to, if known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ExpectedTriangle {
    pub(super) vertices: [Vertex; 3],
    pub(super) face: Option<usize>,
}

/// The buffers of the wrong readers.
pub(super) struct WrongBuffers {
    pub(super) singles: Vec<Hypothesis>,
    pairs: OnceLock<Vec<Hypothesis>>,
}

/// A wrong reader and its buffer.
pub(super) struct Hypothesis {
    pub(super) wrong: WrongReader,
    pub(super) made: Triangles,
}

/// Maximum number of triangles for which all pairs of mistakes are kept: there are thousands of pairs.
const MOST_FOR_PAIRS: usize = 3000;

impl Expected {
    /// Reads a model.
    pub fn from_obj(bytes: &[u8]) -> Result<Self, ReadError> {
        let model = gonio_mesh::obj::read(bytes, &mut NoSidecars, &Limits::default())?;
        let source = ObjLines::parse(bytes);
        let mesh = model.mesh;
        let has = Attributes { tex_coords: !mesh.tex_coords.is_empty(), normals: !mesh.normals.is_empty() };
        let keys = Keys::new(&source);
        let of_mesh = triangles_of(&mesh);
        // The same triangles with their faces, unless the file is written in a way that only gonio-mesh understands.
        let followed: Vec<ExpectedTriangle> = Reader::default().read(&source).iter().filter_map(closed).collect();
        let triangles = if is_same(&of_mesh, &followed, &keys, has) { followed } else { of_mesh };
        Ok(Expected { source, triangles, has, keys, wrong_buffers: Default::default() })
    }

    /// Number of triangles of the model.
    pub fn triangle_count(&self) -> usize {
        self.triangles.len()
    }

    /// Attributes of the model.
    pub fn attributes(&self) -> Attributes {
        self.has
    }

    /// The vertices of the correct buffer, three per triangle.
    pub fn vertices(&self) -> impl Iterator<Item = Vertex> {
        self.triangles.iter().flat_map(|triangle| triangle.vertices)
    }

    pub(super) fn wrong_buffers(&self, compared: Attributes) -> &WrongBuffers {
        self.wrong_buffers[compared.number()].get_or_init(|| WrongBuffers {
            singles: mistakes::singles().into_iter().flat_map(|wrong| self.hypotheses(wrong, compared)).collect(),
            pairs: OnceLock::new(),
        })
    }

    /// All pairs of mistakes; empty for a large model, where trying them all would take too long.
    pub(super) fn pairs(&self, compared: Attributes) -> &[Hypothesis] {
        let make = || {
            if self.triangles.len() > MOST_FOR_PAIRS {
                return Vec::new();
            }
            mistakes::pairs(|_, _| true).into_iter().flat_map(|wrong| self.hypotheses(wrong, compared)).collect()
        };
        self.wrong_buffers(compared).pairs.get_or_init(make)
    }

    fn hypotheses(&self, wrong: WrongReader, compared: Attributes) -> Vec<Hypothesis> {
        let all = Triangles::read(&wrong.reader, &self.source, &self.keys, compared);
        all.into_iter().map(|made| Hypothesis { wrong: wrong.clone(), made }).collect()
    }
}

fn triangles_of(mesh: &Mesh) -> Vec<ExpectedTriangle> {
    let vertex = |index: usize| Vertex {
        position: mesh.positions[index],
        tex_coord: mesh.tex_coords.get(index).copied().unwrap_or_default(),
        normal: mesh.normals.get(index).copied().map_or([0.0; 3], unit),
    };
    let triangle = |t: usize| ExpectedTriangle { vertices: mesh.triangle(t).map(vertex), face: None };
    (0..mesh.triangle_count()).map(triangle).collect()
}

/// A triangle of a correct reader; `None` if an index is out of range.
fn closed(made: &Triangle) -> Option<ExpectedTriangle> {
    let vertex = |i: usize| {
        let corner = made.corners[i];
        Some(Vertex { position: corner.position?, tex_coord: corner.tex_coord?, normal: corner.normal? })
    };
    Some(ExpectedTriangle { vertices: [vertex(0)?, vertex(1)?, vertex(2)?], face: made.face })
}

fn is_same(a: &[ExpectedTriangle], b: &[ExpectedTriangle], keys: &Keys, compared: Attributes) -> bool {
    let given = |triangles: &[ExpectedTriangle]| {
        let vertices: Vec<[Vertex; 3]> = triangles.iter().map(|triangle| triangle.vertices).collect();
        super::fit::SubmittedTriangles::new(&vertices, keys, compared).print
    };
    a.len() == b.len() && given(a) == given(b)
}
