//! Explains one line of an OBJ or MTL file: its meaning, the values its indices refer to, the settings in force, and
//! its problems. [`excerpt`] shows the lines around it, in any text.
//!
//! The file is walked from its start, statement by statement, keeping only the names in force and the values that the
//! line needs: a gigabyte of OBJ takes some seconds and almost no memory. This is separate from the readers' code so
//! that it can explain files that they reject; a test compares the messages of both.

mod excerpt;
mod face;
mod file;
mod mtl;
mod obj;
mod walk;

use crate::encoding::to_utf8;
use crate::{Diagnostic, ReadError};
use serde::Serialize;

pub use excerpt::{Excerpt, excerpt};
pub use face::{FaceCorner, ReferencedAttribute};

/// The longest part of a line or name that is shown, in characters.
const LONGEST: usize = 500;

/// The explanation of a line.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LineExplanation {
    /// The requested line, from 1.
    pub line: u64,
    /// Its text with control characters escaped, cut after 500 characters.
    pub text: String,
    /// The first line of its statement: an earlier one if a `\` joins them.
    pub first_line: u64,
    /// The last line of its statement.
    pub last_line: u64,
    /// The meaning of the line: one sentence without final full stop.
    pub meaning: String,
    /// Details, one line each: for example the corners of a face and the values they refer to.
    pub details: Vec<String>,
    /// The values of the line in structured form.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub value: Option<LineValue>,
    /// The settings of earlier statements that apply to this line.
    pub in_force: Vec<InForce>,
    /// Errors, warnings and notes about the line.
    pub problems: Vec<Diagnostic>,
}

/// The values of a line.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case", tag = "kind")]
pub enum LineValue {
    /// `v`
    Vertex {
        /// Position in the file, from 1.
        number: u64,
        /// Coordinates in the file's own space.
        position: [f32; 3],
        /// The weight w, if written.
        weight: Option<f32>,
        /// The colour r, g, b as written.
        color: Option<[f32; 3]>,
    },
    /// `vt`
    TexCoord {
        /// Position in the file, from 1.
        number: u64,
        /// The coordinates u and v.
        value: [f32; 2],
    },
    /// `vn`
    Normal {
        /// Position in the file, from 1.
        number: u64,
        /// The vector as written.
        written: [f32; 3],
        /// The vector with length 1, or 0.
        unit: [f32; 3],
    },
    /// `f`, `l`, `p`
    Element {
        /// For faces: position in the file, from 1.
        number: u64,
        /// The number of corners.
        corner_count: u64,
        /// The first 64 corners.
        corners: Vec<FaceCorner>,
        /// The triangles of a face, as indices of corners from 1.
        triangles: Vec<[usize; 3]>,
    },
    /// `o`, `g`, `usemtl`, `mtllib`, `newmtl`
    Name {
        /// The name as the reader understands it.
        name: String,
    },
    /// `s`
    SmoothingGroup {
        /// The number of the group; 0 is off.
        group: u32,
    },
    /// A property of a material.
    Property {
        /// The field of [`crate::Material`].
        property: String,
        /// Its value as text.
        value: String,
    },
}

/// A setting in force on a line.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct InForce {
    /// `object`, `group`, `material`, `smoothing group`, `material library`.
    pub what: &'static str,
    /// The name or number.
    pub name: String,
    /// The line that sets it.
    pub line: u64,
}

/// Explains a line (from 1) of an OBJ file. Fails if there is no such line.
pub fn line(bytes: &[u8], line: u64) -> Result<LineExplanation, ReadError> {
    explain_utf8(bytes, line, obj::explain)
}

/// Explains a line (from 1) of a material library. Fails if there is no such line.
///
/// The whole library is read, so that the explanation agrees with what a model gets.
pub fn mtl_line(bytes: &[u8], line: u64) -> Result<LineExplanation, ReadError> {
    explain_utf8(bytes, line, mtl::explain)
}

/// Explains a line of the text as UTF-8; losses of the conversion on that line are among its problems.
fn explain_utf8(
    bytes: &[u8],
    line: u64,
    explain: impl FnOnce(&[u8], u64) -> Result<LineExplanation, ReadError>,
) -> Result<LineExplanation, ReadError> {
    let text = to_utf8(bytes);
    let mut explanation = explain(&text.bytes, line)?;
    let lost = text.diagnostics.into_iter().filter(|lost| lost.place.line == Some(line));
    explanation.problems.splice(..0, lost);
    Ok(explanation)
}
