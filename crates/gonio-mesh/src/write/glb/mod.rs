//! Writes a model as binary glTF 2.0 (`.glb`) that needs no other file.
//!
//! Reading it again gives the same model: [`crate::gltf`] documents the rule between the two kinds of material, whose
//! inverse is applied here. Parts are primitives; those with one name share a mesh and its node. Lights and cameras are
//! not written.

mod material;

use crate::diagnostic::Reports;
use crate::{Diagnostic, Mesh, Model, Part, TextureMap};
use material::{MaterialWriter, TextureWriter};
use serde_json::{Map, Value, json};
use std::fmt;
use std::ops::Range;

/// Most vertices with 16-bit indices; 65535 itself would end a strip.
const MOST_IN_16_BITS: usize = 65_535;

/// A model written as binary glTF.
#[derive(Clone, Debug)]
pub struct Glb {
    /// The contents of the file.
    pub bytes: Vec<u8>,
    /// The parts of the model that were not written.
    pub diagnostics: Vec<Diagnostic>,
}

/// A model that needs more bytes than the 32-bit size of a `.glb` allows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TooLarge {
    /// The number of bytes it needs.
    pub bytes: u64,
}

impl fmt::Display for TooLarge {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "the model takes {} bytes, but a .glb can hold at most {}: write another format",
            self.bytes,
            u32::MAX
        )
    }
}

impl std::error::Error for TooLarge {}

/// Writes `model`. `images` returns the bytes of an image that is not inside the model (PNG or JPEG); a texture without
/// bytes is left out with a warning.
pub fn write(model: &Model, images: &mut dyn FnMut(&TextureMap) -> Option<Vec<u8>>) -> Result<Glb, TooLarge> {
    let mut reports = Reports::default();
    let mut buffer = Buffer::default();
    let (meshes, nodes) = meshes(&model.mesh, model.materials.len(), &mut buffer, &mut reports);
    let textures = TextureWriter::new(&model.images, images);
    let mut writer = MaterialWriter { textures, buffer: &mut buffer, reports: &mut reports };
    let materials: Vec<Value> = model.materials.iter().map(|material| writer.material(material)).collect();
    let textures = writer.textures.finish();
    if !(model.lights.is_empty() && model.cameras.is_empty()) {
        let (lights, cameras) = (model.lights.len(), model.cameras.len());
        reports.push(0, Diagnostic::warning(format!("lights ({lights}) and cameras ({cameras}) are not written")));
    }
    let mut root = json!({ "asset": { "version": "2.0", "generator": "gonio" } });
    if !nodes.is_empty() {
        root["scene"] = 0.into();
        root["scenes"] = json!([{ "nodes": (0..nodes.len()).collect::<Vec<_>>() }]);
    }
    let (binary, views, accessors) = buffer.finish();
    let lists = [
        ("nodes", nodes),
        ("meshes", meshes),
        ("materials", materials),
        ("bufferViews", views),
        ("accessors", accessors),
        ("textures", textures.textures),
        ("samplers", textures.samplers),
        ("images", textures.images),
    ];
    // An empty list is not allowed.
    for (key, list) in lists.into_iter().filter(|(_, list)| !list.is_empty()) {
        root[key] = list.into();
    }
    if !binary.is_empty() {
        root["buffers"] = json!([{ "byteLength": binary.len() }]);
    }
    let used = extensions_used(&root);
    if !used.is_empty() {
        root["extensionsUsed"] = used.into();
    }
    Ok(Glb { bytes: container(&root, &binary)?, diagnostics: reports.finish() })
}

/// Returns the names of all extensions in the materials.
fn extensions_used(root: &Value) -> Vec<Value> {
    const NAMES: [&str; 4] =
        ["KHR_materials_emissive_strength", "KHR_materials_ior", "KHR_materials_specular", "KHR_texture_transform"];
    fn holds(value: &Value, name: &str) -> bool {
        match value {
            Value::Object(map) => map.contains_key(name) || map.values().any(|value| holds(value, name)),
            Value::Array(list) => list.iter().any(|value| holds(value, name)),
            _ => false,
        }
    }
    let materials = root.get("materials").unwrap_or(&Value::Null);
    NAMES.into_iter().filter(|name| holds(materials, name)).map(Value::from).collect()
}

/// Assembles header, JSON and binary chunk, each chunk a multiple of 4 bytes long.
fn container(root: &Value, binary: &[u8]) -> Result<Vec<u8>, TooLarge> {
    let mut json = root.to_string().into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let binary_length = binary.len().next_multiple_of(4);
    let binary_chunk = if binary.is_empty() { 0 } else { 8 + binary_length };
    let total = 12 + 8 + json.len() + binary_chunk;
    let length = |length: usize| u32::try_from(length).map(u32::to_le_bytes);
    let too_large = |_| TooLarge { bytes: total as u64 };
    let mut bytes = Vec::with_capacity(total);
    bytes.extend(b"glTF\x02\0\0\0");
    bytes.extend(length(total).map_err(too_large)?);
    bytes.extend(length(json.len()).map_err(too_large)?);
    bytes.extend(b"JSON");
    bytes.extend(json);
    if !binary.is_empty() {
        bytes.extend(length(binary_length).map_err(too_large)?);
        bytes.extend(b"BIN\0");
        bytes.extend(binary);
        bytes.resize(total, 0);
    }
    Ok(bytes)
}

/// Writes a mesh and a node for each span of parts with one name.
fn meshes(mesh: &Mesh, materials: usize, buffer: &mut Buffer, reports: &mut Reports) -> (Vec<Value>, Vec<Value>) {
    let whole = [Part { triangle_count: mesh.triangle_count(), material: usize::MAX, ..Part::default() }];
    let parts = if mesh.parts.is_empty() { &whole[..] } else { &mesh.parts };
    let arrays = Arrays::write(mesh, buffer);
    let (mut meshes, mut nodes) = (Vec::new(), Vec::new());
    for run in parts.chunk_by(|a, b| a.name == b.name) {
        let primitives: Vec<Value> =
            run.iter().filter_map(|part| primitive(mesh, part, materials, &arrays, buffer, reports)).collect();
        if primitives.is_empty() {
            continue;
        }
        let mut named = Map::new();
        if !run[0].name.is_empty() {
            named.insert("name".to_owned(), run[0].name.as_str().into());
        }
        let mut node = named.clone();
        node.insert("mesh".to_owned(), meshes.len().into());
        named.insert("primitives".to_owned(), primitives.into());
        meshes.push(Value::Object(named));
        nodes.push(Value::Object(node));
    }
    (meshes, nodes)
}

/// Views of the whole mesh's arrays, of which each primitive uses a range.
struct Arrays {
    positions: usize,
    normals: Option<usize>,
    tangents: Option<usize>,
    tex_coords: Option<usize>,
    second_tex_coords: Option<usize>,
    colors: Option<usize>,
}

impl Arrays {
    fn write(mesh: &Mesh, buffer: &mut Buffer) -> Self {
        let count = mesh.positions.len();
        let fits = |length: usize| length == count && count > 0;
        let flipped = |[u, v]: &[f32; 2]| [*u, 1.0 - v];
        let mut uv_view = |uvs: &[[f32; 2]]| fits(uvs.len()).then(|| buffer.vertices(uvs.iter().map(flipped)));
        let tex_coords = uv_view(&mesh.tex_coords);
        // Sets are numbered without gaps.
        let second_tex_coords = tex_coords.and_then(|_| uv_view(&mesh.second_tex_coords));
        Arrays {
            positions: if count == 0 { 0 } else { buffer.vertices(mesh.positions.iter().copied()) },
            normals: fits(mesh.normals.len()).then(|| buffer.vertices(mesh.normals.iter().copied())),
            // Tangents are useless without normals.
            tangents: (fits(mesh.tangents.len()) && fits(mesh.normals.len()))
                .then(|| buffer.vertices(mesh.tangents.iter().copied())),
            tex_coords,
            second_tex_coords,
            colors: fits(mesh.colors.len()).then(|| buffer.vertices(mesh.colors.iter().copied())),
        }
    }
}

/// Writes the primitive of a part; `None` if it has no triangles.
fn primitive(
    mesh: &Mesh,
    part: &Part,
    materials: usize,
    arrays: &Arrays,
    buffer: &mut Buffer,
    reports: &mut Reports,
) -> Option<Value> {
    let first = part.first_triangle.checked_mul(3)?;
    let indices = mesh.indices.get(first..part.triangle_count.checked_mul(3)?.checked_add(first)?)?;
    let (least, most) = (*indices.iter().min()? as usize, *indices.iter().max()? as usize);
    let range = least..most + 1;
    let positions = mesh.positions.get(range.clone())?;
    let count = range.len();
    let index_list = indices.iter().map(|&index| index - least as u32);
    let indices = if count <= MOST_IN_16_BITS { buffer.short_indices(index_list) } else { buffer.indices(index_list) };
    let mut attributes = Map::new();
    attributes.insert("POSITION".to_owned(), buffer.positions(arrays.positions, &range, positions).into());
    let normals = arrays.normals.filter(|_| has_normals(mesh, &range, part, reports));
    let vectors = [
        ("NORMAL", normals, "VEC3", 12),
        ("TANGENT", arrays.tangents.filter(|_| normals.is_some()), "VEC4", 16),
        ("TEXCOORD_0", arrays.tex_coords, "VEC2", 8),
        ("TEXCOORD_1", arrays.second_tex_coords, "VEC2", 8),
        ("COLOR_0", arrays.colors, "VEC4", 16),
    ];
    for (name, view, kind, size) in vectors {
        if let Some(view) = view {
            attributes.insert(name.to_owned(), buffer.stretch(view, &range, kind, size).into());
        }
    }
    let mut primitive = json!({ "attributes": attributes, "indices": indices });
    if part.material < materials {
        primitive["material"] = part.material.into();
    }
    Some(primitive)
}

/// Whether all normals of a part are of unit length, as glTF requires.
fn has_normals(mesh: &Mesh, range: &Range<usize>, part: &Part, reports: &mut Reports) -> bool {
    let is_unit = |n: &[f32; 3]| (n.iter().map(|c| c * c).sum::<f32>() - 1.0).abs() < 1e-3;
    let all = mesh.normals.get(range.clone()).is_some_and(|normals| normals.iter().all(is_unit));
    if !all {
        let message = || format!("the part {:?} lacks some normals: none of them is written", part.name);
        reports.add_without_line("parts without all normals", crate::Severity::Warning, message);
    }
    all
}

const ARRAY_BUFFER: u32 = 34_962;
const ELEMENT_ARRAY_BUFFER: u32 = 34_963;
const U16: u32 = 5123;
const U32: u32 = 5125;
const F32: u32 = 5126;

#[derive(Default)]
struct Buffer {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl Buffer {
    /// Returns the bytes, views and accessors.
    pub fn finish(self) -> (Vec<u8>, Vec<Value>, Vec<Value>) {
        (self.bytes, self.views, self.accessors)
    }

    /// Appends vectors as a view that several accessors may share.
    pub fn vertices<const N: usize>(&mut self, vectors: impl Iterator<Item = [f32; N]>) -> usize {
        let first = self.bytes.len();
        self.bytes.extend(vectors.flatten().flat_map(f32::to_le_bytes));
        self.view(first, json!({ "target": ARRAY_BUFFER, "byteStride": 4 * N }))
    }

    /// Appends an image file.
    pub fn file(&mut self, bytes: &[u8]) -> usize {
        let first = self.bytes.len();
        self.bytes.extend(bytes);
        self.view(first, json!({}))
    }

    /// Adds a view of the bytes since `first`, padded so that the next view begins at a multiple of 4.
    fn view(&mut self, first: usize, mut view: Value) -> usize {
        view["buffer"] = 0.into();
        view["byteOffset"] = first.into();
        view["byteLength"] = (self.bytes.len() - first).into();
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        self.views.push(view);
        self.views.len() - 1
    }

    fn accessor(&mut self, accessor: Value) -> usize {
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }

    /// Adds an accessor for a range of a view's vectors of `size` bytes each.
    pub fn stretch(&mut self, view: usize, range: &Range<usize>, kind: &str, size: usize) -> usize {
        self.accessor(json!({
            "bufferView": view, "byteOffset": range.start * size, "count": range.len(), "componentType": F32,
            "type": kind,
        }))
    }

    /// Adds an accessor for positions, which requires their bounds.
    pub fn positions(&mut self, view: usize, range: &Range<usize>, positions: &[[f32; 3]]) -> usize {
        let fold = |start: f32, pick: fn(f32, f32) -> f32| {
            positions.iter().fold([start; 3], |found, p| [0, 1, 2].map(|i| pick(found[i], p[i])))
        };
        let accessor = self.stretch(view, range, "VEC3", 12);
        self.accessors[accessor]["min"] = fold(f32::INFINITY, f32::min).to_vec().into();
        self.accessors[accessor]["max"] = fold(f32::NEG_INFINITY, f32::max).to_vec().into();
        accessor
    }

    /// Appends indices of 16 bits.
    pub fn short_indices(&mut self, indices: impl Iterator<Item = u32>) -> usize {
        let first = self.bytes.len();
        self.bytes.extend(indices.flat_map(|index| (index as u16).to_le_bytes()));
        self.index_accessor(first, U16, 2)
    }

    /// Appends indices of 32 bits.
    pub fn indices(&mut self, indices: impl Iterator<Item = u32>) -> usize {
        let first = self.bytes.len();
        self.bytes.extend(indices.flat_map(u32::to_le_bytes));
        self.index_accessor(first, U32, 4)
    }

    fn index_accessor(&mut self, first: usize, component: u32, size: usize) -> usize {
        let count = (self.bytes.len() - first) / size;
        let view = self.view(first, json!({ "target": ELEMENT_ARRAY_BUFFER }));
        self.accessor(json!({ "bufferView": view, "componentType": component, "count": count, "type": "SCALAR" }))
    }
}
