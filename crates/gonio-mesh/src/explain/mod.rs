//! One line of an OBJ or MTL in words: what it says, what its indices point at, what holds there, what is wrong.
//!
//! The file is walked over from its start, statement by statement, with nothing kept but the names in force and what
//! the line asks for: a gigabyte of OBJ takes some seconds and no memory to speak of. This is not the readers' code, so
//! that it stands a file that they refuse; a test holds what both say of the same lines against each other.

mod face;
mod file;
mod mtl;
mod obj;
mod walk;

use crate::encoding::to_utf8;
use crate::{Diagnostic, ReadError};
use serde::Serialize;

pub use face::{FaceCorner, ReferencedAttribute};

/// The longest part of a line or name that is shown, in characters.
const LONGEST: usize = 500;

/// What a line says.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LineExplanation {
    /// The line that was asked for, from 1.
    pub line: u64,
    /// Its text, control characters escaped, cut after 500 characters.
    pub text: String,
    /// Where its statement begins: an earlier line, where a `\` joins them.
    pub first_line: u64,
    /// Where its statement ends.
    pub last_line: u64,
    /// One sentence without final full stop: what it says.
    pub meaning: String,
    /// More of it, a line each: the corners of a face and what they point at.
    pub details: Vec<String>,
    /// The same in numbers.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub value: Option<LineValue>,
    /// What earlier statements say that holds on this line.
    pub in_force: Vec<InForce>,
    /// What is wrong with it, or worth knowing.
    pub problems: Vec<Diagnostic>,
}

/// What a line gives.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case", tag = "kind")]
pub enum LineValue {
    /// `v`
    Vertex {
        /// Counted in the file, from 1.
        number: u64,
        /// In the file's own space.
        position: [f32; 3],
        /// w, where it is written.
        weight: Option<f32>,
        /// r, g, b as written.
        color: Option<[f32; 3]>,
    },
    /// `vt`
    TexCoord {
        /// Counted in the file, from 1.
        number: u64,
        /// u and v.
        value: [f32; 2],
    },
    /// `vn`
    Normal {
        /// Counted in the file, from 1.
        number: u64,
        /// As written.
        written: [f32; 3],
        /// Of length 1, or 0.
        unit: [f32; 3],
    },
    /// `f`, `l`, `p`
    Element {
        /// Of faces: counted in the file, from 1.
        number: u64,
        /// How many corners are written.
        corner_count: u64,
        /// The first 64 of them.
        corners: Vec<FaceCorner>,
        /// The triangles that a face is cut into: its corners, counted from 1.
        triangles: Vec<[usize; 3]>,
    },
    /// `o`, `g`, `usemtl`, `mtllib`, `newmtl`
    Name {
        /// As it is taken.
        name: String,
    },
    /// `s`
    SmoothingGroup {
        /// 0 is off.
        group: u32,
    },
    /// A property of a material.
    Property {
        /// A field of [`crate::Material`].
        property: String,
        /// Its value, in words.
        value: String,
    },
}

/// What holds on a line.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct InForce {
    /// `object`, `group`, `material`, `smoothing group`, `material library`.
    pub what: &'static str,
    /// Its name or number.
    pub name: String,
    /// The line that says so.
    pub line: u64,
}

/// Explains a line (from 1) of an OBJ file. Errors: there is no such line.
pub fn line(bytes: &[u8], line: u64) -> Result<LineExplanation, ReadError> {
    explain_utf8(bytes, line, obj::explain)
}

/// Explains a line (from 1) of a material library. Errors: there is no such line.
///
/// The whole library is read for it, so that what is said is what a model gets.
pub fn mtl_line(bytes: &[u8], line: u64) -> Result<LineExplanation, ReadError> {
    explain_utf8(bytes, line, mtl::explain)
}

/// Explains a line of the text as UTF-8; what the conversion lost on that line is one of its problems.
fn explain_utf8(
    bytes: &[u8],
    line: u64,
    explain: impl FnOnce(&[u8], u64) -> Result<LineExplanation, ReadError>,
) -> Result<LineExplanation, ReadError> {
    let text = to_utf8(bytes);
    let mut explanation = explain(&text.bytes, line)?;
    let lost = text.diagnostics.into_iter().filter(|lost| lost.line == Some(line));
    explanation.problems.splice(..0, lost);
    Ok(explanation)
}
