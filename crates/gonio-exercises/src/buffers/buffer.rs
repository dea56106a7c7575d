//! A student's vertex buffer, in whichever format it came.

use super::error::BufferError;
use super::vertex::{Attributes, Vertex, unit};
use super::{json, raw, table};

/// Most bytes of a file.
pub const MOST_BYTES: usize = 100 << 20;

/// A vertex buffer as it was read. What columns without names mean is decided when it is compared with a model.
#[derive(Clone, Debug, PartialEq)]
pub struct Buffer {
    pub(super) data: Data,
    /// What was survived, a sentence each.
    pub warnings: Vec<String>,
}

#[derive(Clone, Debug, PartialEq)]
pub(super) enum Data {
    /// The file says what its columns are. Three vertices a triangle.
    Named { vertices: Vec<Vertex>, has: Attributes },
    /// So many numbers a row, without names.
    Rows { values: Vec<f32>, width: usize },
    /// Bytes without rows.
    Raw { bytes: Vec<u8>, stride: Option<usize> },
}

/// One way of taking a buffer's columns.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Reading {
    pub(super) vertices: Vec<Vertex>,
    pub(super) has: Attributes,
    /// What is unusual about it.
    pub(super) remark: Option<&'static str>,
}

/// Columns without names: how many there are, and what they hold.
struct Layout {
    width: usize,
    /// Where it starts.
    tex_coord: Option<usize>,
    /// Where it starts.
    normal: Option<usize>,
    remark: Option<&'static str>,
}

const LAYOUTS: [Layout; 5] = [
    Layout { width: 8, tex_coord: Some(3), normal: Some(5), remark: None },
    Layout {
        width: 8,
        tex_coord: Some(6),
        normal: Some(3),
        remark: Some("the columns are x y z nx ny nz u v here; expected x y z u v nx ny nz"),
    },
    Layout { width: 6, tex_coord: None, normal: Some(3), remark: None },
    Layout { width: 5, tex_coord: Some(3), normal: None, remark: None },
    Layout { width: 3, tex_coord: None, normal: None, remark: None },
];

/// Column counts that a buffer without names may have.
pub(super) const WIDTHS: [usize; 4] = [3, 5, 6, 8];

/// Reads a vertex buffer: CSV (or semicolons, tabs, blanks), JSON or raw little-endian floats, by the file's ending, or
/// by its content where that says nothing. The ending `.raw8` (`6`, `5`, `3`) states the floats of a vertex.
pub fn read_buffer(name: &str, bytes: &[u8]) -> Result<Buffer, BufferError> {
    if bytes.len() > MOST_BYTES {
        let message = format!("the file has {} MB; at most {} are read", bytes.len() >> 20, MOST_BYTES >> 20);
        return Err(BufferError::new(message));
    }
    if bytes.is_empty() {
        return Err(BufferError::new("the file is empty: was it closed before the program ended?"));
    }
    let ending = name.rsplit_once('.').map_or(String::new(), |(_, ending)| ending.to_ascii_lowercase());
    let is_text = raw::looks_like_text(bytes);
    match ending.as_str() {
        "json" => json::read(bytes),
        "csv" | "tsv" | "txt" => table::read(bytes),
        "raw" | "bin" | "f32" | "dat" if !is_text => raw::read(bytes, None),
        "raw8" | "raw6" | "raw5" | "raw3" if !is_text => {
            raw::read(bytes, ending.bytes().last().map(|digit| usize::from(digit - b'0')))
        }
        _ if !is_text => raw::read(bytes, None),
        _ => match bytes.trim_ascii_start().first() {
            Some(b'[' | b'{') => json::read(bytes),
            _ => table::read(bytes),
        },
    }
}

impl Buffer {
    /// Every way of taking the columns, the documented one first; never empty.
    pub(super) fn readings(&self) -> Vec<Reading> {
        match &self.data {
            Data::Named { vertices, has } => {
                vec![Reading { vertices: vertices.clone(), has: *has, remark: None }]
            }
            Data::Rows { values, width } => by_width(values, *width, None),
            Data::Raw { bytes, stride } => raw::readings(bytes, *stride),
        }
    }
}

/// The readings of rows of `width` numbers.
pub(super) fn by_width(values: &[f32], width: usize, remark: Option<&'static str>) -> Vec<Reading> {
    let layouts = LAYOUTS.iter().filter(|layout| layout.width == width);
    layouts
        .map(|layout| Reading {
            vertices: values.chunks_exact(width).map(|row| vertex(row, layout.tex_coord, layout.normal)).collect(),
            has: Attributes { tex_coords: layout.tex_coord.is_some(), normals: layout.normal.is_some() },
            remark: remark.or(layout.remark),
        })
        .collect()
}

fn vertex(row: &[f32], tex_coord: Option<usize>, normal: Option<usize>) -> Vertex {
    let at = |i: usize| row.get(i).copied().unwrap_or(0.0);
    Vertex {
        position: [at(0), at(1), at(2)],
        tex_coord: tex_coord.map_or([0.0; 2], |i| [at(i), at(i + 1)]),
        normal: normal.map_or([0.0; 3], |i| unit([at(i), at(i + 1), at(i + 2)])),
    }
}
