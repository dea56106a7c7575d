//! Medit `.mesh` and `.meshb`: meshes of simulations (P. Frey, 2001, "MEDIT: an interactive mesh visualization
//! software", INRIA RT-0253; L. Maréchal, "The libMeshb library version 7", INRIA).

mod ascii;
mod binary;
mod build;
mod content;
mod keywords;
mod surface;

use crate::encoding::read_as_utf8;
use crate::report::Reports;
use crate::{Diagnostic, Limits, Model, ReadError, Severity, Sidecars};
use content::{Content, Locator};

/// Reads a Medit file, a text or a binary file of version 1 to 4 in either byte order. It refers to no other files.
///
/// - Surface elements are drawn (`Triangles`, `Quadrilaterals`; curved ones by their corners). Only if a file has none
///   of them, volume elements (`Tetrahedra`, `Prisms`, `Hexahedra`, `Pyramids`) are drawn by their boundary: the faces
///   that belong to only one of them, fronts outward.
/// - References become parts in ascending order, each with a material `ref N`. Reference 0 is clay; the hue of another
///   one is N times the golden section of the circle of hues. More than 1,024 different ones are merged into one part.
/// - Two-dimensional meshes are at z = 0.
/// - Normals come from `NormalAtTriangleVertices` and `NormalAtQuadrilateralVertices` (one row of normals for each
///   element), then from `NormalAtVertices`; they are zero if neither defines one ([`crate::normals::complete`]
///   computes them).
/// - Other known keywords are counted in [`Model::contents`]. Unknown keywords are skipped.
///
/// An element with an index out of range is left out with a warning. Errors are: text in place of a number, a
/// coordinate that is not finite, a count beyond the end of the file, a broken chain of sections, no faces, and more
/// data than `limits` allow. Positions in binary files are reported as bytes from 1.
pub fn read(bytes: &[u8], _sidecars: &mut dyn Sidecars, limits: &Limits) -> Result<Model, ReadError> {
    read_as_utf8(bytes, |bytes| read_utf8(bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes), limits))
}

/// Reads a binary file, or a text in UTF-8.
fn read_utf8(bytes: &[u8], limits: &Limits) -> Result<Model, ReadError> {
    let mut reports = Reports::default();
    let (content, locator) = if binary::is_binary(bytes) {
        binary::read(bytes, limits, &mut reports)?
    } else {
        ascii::read(bytes, limits, &mut reports)?
    };
    report_not_drawn(&content, &locator, &mut reports);
    let faces = surface::faces(&content, &locator, &mut reports);
    if faces.is_empty() {
        return Err(nothing_to_draw(&content, &reports));
    }
    let (mesh, materials) = build::build(&content, faces, &locator, limits, &mut reports)?;
    let contents = content.counts.iter().map(|(keyword, count, _)| (keyword.name.to_owned(), *count)).collect();
    Ok(Model { mesh, materials, contents, diagnostics: reports.finish(), ..Model::default() })
}

fn report_not_drawn(content: &Content, locator: &Locator<'_>, reports: &mut Reports) {
    let ignored = || content.counts.iter().filter(|(k, count, _)| k.rows == keywords::Rows::Counted && *count > 0);
    let names: Vec<&str> = ignored().map(|(keyword, ..)| keyword.name).collect();
    if let Some((.., at)) = ignored().next() {
        locator.report(Severity::Note, *at, reports, format!("{} are not drawn", names.join(", ")));
    }
}

#[cold]
fn nothing_to_draw(content: &Content, reports: &Reports) -> ReadError {
    let counts: Vec<String> =
        content.counts.iter().map(|(keyword, count, _)| format!("{count} {}", keyword.name)).collect();
    let counts = if counts.is_empty() { "no known keyword".to_owned() } else { counts.join(", ") };
    let why = match reports.first() {
        Some(Diagnostic { message, line: Some(line), .. }) => format!("; line {line}: {message}"),
        Some(Diagnostic { message, .. }) => format!("; {message}"),
        None => String::new(),
    };
    ReadError::new(format!("contains no faces ({counts}): nothing to draw{why}"))
}
