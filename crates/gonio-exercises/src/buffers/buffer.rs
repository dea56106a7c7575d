//! A student's vertex buffer, in whichever format it came, and the vertices in it.

use gonio_language::tr;
use serde::Serialize;
use std::fmt;

/// A vertex of a triangle list.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Vertex {
    /// Position in model space, in the model's unit.
    pub position: [f32; 3],
    /// u to the right, v up; zero if the model has none.
    pub tex_coord: [f32; 2],
    /// Unit normal; zero if absent.
    pub normal: [f32; 3],
}

/// The attributes that exist besides the position.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Attributes {
    /// Texture coordinates.
    pub tex_coords: bool,
    /// Normals.
    pub normals: bool,
}

impl Attributes {
    /// A number from 0 to 3, different for each combination.
    pub(super) fn number(self) -> usize {
        usize::from(self.tex_coords) + 2 * usize::from(self.normals)
    }

    pub(super) fn and(self, other: Attributes) -> Attributes {
        Attributes { tex_coords: self.tex_coords && other.tex_coords, normals: self.normals && other.normals }
    }
}

/// The vector at unit length. Vectors of length 0 and vectors that are not finite stay unchanged.
pub(super) fn unit(normal: [f32; 3]) -> [f32; 3] {
    let wide = normal.map(f64::from);
    let length = wide.iter().map(|x| x * x).sum::<f64>().sqrt();
    if length.is_finite() && length > 1e-12 { wide.map(|x| (x / length) as f32) } else { normal }
}

/// A vertex buffer as it was read. The meaning of columns without names is decided when it is compared with a model.
#[derive(Clone, Debug, PartialEq)]
pub struct Buffer {
    pub(super) data: Data,
    /// Oddities in the file, one sentence each.
    pub warnings: Vec<String>,
}

#[derive(Clone, Debug, PartialEq)]
pub(super) enum Data {
    /// The file names its columns. Three vertices per triangle.
    Named { vertices: Vec<Vertex>, has: Attributes },
    /// Rows of `width` numbers, without names.
    Rows { values: Vec<f32>, width: usize },
    /// Bytes without rows.
    Raw { bytes: Vec<u8>, stride: Option<usize> },
}

/// One interpretation of a buffer's columns.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Reading {
    pub(super) vertices: Vec<Vertex>,
    pub(super) has: Attributes,
    /// A warning if this interpretation is unusual.
    /// The id of a remark.
    pub(super) remark: Option<&'static str>,
}

/// A meaning of columns without names.
struct Layout {
    width: usize,
    /// First column of the texture coordinate.
    tex_coord: Option<usize>,
    /// First column of the normal.
    normal: Option<usize>,
    /// The id of a remark.
    remark: Option<&'static str>,
}

const LAYOUTS: [Layout; 5] = [
    Layout { width: 8, tex_coord: Some(3), normal: Some(5), remark: None },
    Layout { width: 8, tex_coord: Some(6), normal: Some(3), remark: Some("check-buffer-the-columns-are-x-y-z") },
    Layout { width: 6, tex_coord: None, normal: Some(3), remark: None },
    Layout { width: 5, tex_coord: Some(3), normal: None, remark: None },
    Layout { width: 3, tex_coord: None, normal: None, remark: None },
];

/// Column counts that a buffer without names may have.
pub(super) const WIDTHS: [usize; 4] = [3, 5, 6, 8];

impl Buffer {
    /// All interpretations of the columns, the documented one first; never empty.
    pub(super) fn readings(&self) -> Vec<Reading> {
        match &self.data {
            Data::Named { vertices, has } => {
                vec![Reading { vertices: vertices.clone(), has: *has, remark: None }]
            }
            Data::Rows { values, width } => by_width(values, *width, None),
            Data::Raw { bytes, stride } => readings_of_bytes(bytes, *stride),
        }
    }
}

/// The readings of rows of `width` numbers.
fn by_width(values: &[f32], width: usize, remark: Option<&'static str>) -> Vec<Reading> {
    let layouts = LAYOUTS.iter().filter(|layout| layout.width == width);
    layouts
        .map(|layout| Reading {
            vertices: values.chunks_exact(width).map(|row| vertex(row, layout.tex_coord, layout.normal)).collect(),
            has: Attributes { tex_coords: layout.tex_coord.is_some(), normals: layout.normal.is_some() },
            remark: remark.or(layout.remark),
        })
        .collect()
}

/// Interpretations as 32-bit floats, then as 64-bit floats, which are the default of NumPy and JavaScript.
fn readings_of_bytes(bytes: &[u8], stride: Option<usize>) -> Vec<Reading> {
    const DOUBLES: &str = "check-buffer-the-numbers-are-64-bit-floats";
    let singles: Vec<f32> = bytes.chunks_exact(4).map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect();
    let doubles = bytes.chunks_exact(8).map(|b| f64::from_le_bytes([b[0], b[1], b[2], b[3], b[4], b[5], b[6], b[7]]));
    let doubles: Vec<f32> = doubles.map(|x| x as f32).collect();
    let mut readings = Vec::new();
    for (values, remark) in [(&singles, None), (&doubles, Some(DOUBLES))] {
        for width in WIDTHS.iter().rev().filter(|width| stride.is_none_or(|stride| stride == **width)) {
            if !values.is_empty() && values.len().is_multiple_of(*width) {
                readings.extend(by_width(values, *width, remark));
            }
        }
    }
    readings
}

fn vertex(row: &[f32], tex_coord: Option<usize>, normal: Option<usize>) -> Vertex {
    let at = |i: usize| row.get(i).copied().unwrap_or(0.0);
    Vertex {
        position: [at(0), at(1), at(2)],
        tex_coord: tex_coord.map_or([0.0; 2], |i| [at(i), at(i + 1)]),
        normal: normal.map_or([0.0; 3], |i| unit([at(i), at(i + 1), at(i + 2)])),
    }
}

/// The reason why a file is not a vertex buffer, and the place in the file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct BufferError {
    /// The error and how to fix it, in one sentence.
    pub message: String,
    /// Line, from 1; `None` if the error concerns the whole file, or if the file has no lines.
    pub line: Option<u64>,
    /// Column in bytes, from 1.
    pub column: Option<u64>,
}

impl BufferError {
    /// An error about the whole file.
    pub fn new(message: impl Into<String>) -> Self {
        BufferError { message: message.into(), line: None, column: None }
    }

    /// The same error at a line and, if known, a column.
    pub fn at(mut self, line: u64, column: Option<u64>) -> Self {
        self.line = Some(line);
        self.column = column;
        self
    }
}

impl fmt::Display for BufferError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let message = self.message.as_str();
        match (self.line, self.column) {
            (None, _) => f.write_str(message),
            (Some(line), None) => f.write_str(&tr!("check-buffer-line", line = line, message = message)),
            (Some(line), Some(column)) => {
                f.write_str(&tr!("check-buffer-line-column", line = line, column = column, message = message))
            }
        }
    }
}

impl std::error::Error for BufferError {}
