//! Medit `.mesh` and `.meshb`: meshes of simulations (P. Frey, 2001, "MEDIT: an interactive mesh visualization
//! software", INRIA RT-0253; L. Maréchal, "The libMeshb library version 7", INRIA).

mod ascii;
mod binary;
mod build;
mod content;
mod surface;

use crate::diagnostic::Reports;
use crate::encoding::read_as_utf8;
use crate::{Diagnostic, FilePlace, Limits, Model, ReadError, Severity, Sidecars};
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
    let ignored = || content.counts.iter().filter(|(k, count, _)| k.rows == Rows::Counted && *count > 0);
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
    let reason = match reports.first() {
        Some(Diagnostic { message, place: FilePlace { line: Some(line), .. }, .. }) => {
            format!("; line {line}: {message}")
        }
        Some(Diagnostic { message, .. }) => format!("; {message}"),
        None => String::new(),
    };
    ReadError::new(format!("contains no faces ({counts}): nothing to draw{reason}"))
}

/// The contents of a keyword's rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Rows {
    /// One integer, 2 or 3, without a count.
    Dimension,
    /// Coordinates and a reference.
    Vertices,
    /// The indices of `nodes` vertices, of which the first `corners` are the corners, and a reference.
    Surface { corners: usize, nodes: usize },
    /// Like surfaces, for a volume element.
    Volume { corners: usize, nodes: usize },
    /// The coordinates of a vector.
    Normals,
    /// The indices of a vertex and a normal.
    NormalAtVertices,
    /// A normal for each corner of the element with the same number, which has so many corners.
    NormalAtCorners(usize),
    /// Counted but not drawn.
    Counted,
    /// No count, not drawn.
    Bare,
    /// The end of the file.
    End,
}

#[derive(Debug)]
struct Keyword {
    name: &'static str,
    code: u32,
    rows: Rows,
}

const fn keyword(name: &'static str, code: u32, rows: Rows) -> Keyword {
    Keyword { name, code, rows }
}

const fn surface(corners: usize, nodes: usize) -> Rows {
    Rows::Surface { corners, nodes }
}

const fn volume(corners: usize, nodes: usize) -> Rows {
    Rows::Volume { corners, nodes }
}

/// All known keywords. `MeshVersionFormatted` is read before them.
const KEYWORDS: &[Keyword] = &[
    keyword("Dimension", 3, Rows::Dimension),
    keyword("Vertices", 4, Rows::Vertices),
    keyword("Edges", 5, Rows::Counted),
    keyword("Triangles", 6, surface(3, 3)),
    keyword("Quadrilaterals", 7, surface(4, 4)),
    keyword("Tetrahedra", 8, volume(4, 4)),
    keyword("Prisms", 9, volume(6, 6)),
    keyword("Hexahedra", 10, volume(8, 8)),
    keyword("Corners", 13, Rows::Counted),
    keyword("Ridges", 14, Rows::Counted),
    keyword("RequiredVertices", 15, Rows::Counted),
    keyword("RequiredEdges", 16, Rows::Counted),
    keyword("RequiredTriangles", 17, Rows::Counted),
    keyword("RequiredQuadrilaterals", 18, Rows::Counted),
    keyword("TangentAtEdgeVertices", 19, Rows::Counted),
    keyword("NormalAtVertices", 20, Rows::NormalAtVertices),
    keyword("NormalAtTriangleVertices", 21, Rows::NormalAtCorners(3)),
    keyword("NormalAtQuadrilateralVertices", 22, Rows::NormalAtCorners(4)),
    keyword("AngleOfCornerBound", 23, Rows::Bare),
    keyword("TrianglesP2", 24, surface(3, 6)),
    keyword("EdgesP2", 25, Rows::Counted),
    keyword("QuadrilateralsQ2", 27, surface(4, 9)),
    keyword("SubDomainFromGeom", 29, Rows::Counted),
    keyword("TetrahedraP2", 30, volume(4, 10)),
    keyword("HexahedraQ2", 33, volume(8, 27)),
    keyword("Polyhedra", 46, Rows::Counted),
    keyword("Polygons", 47, Rows::Bare),
    keyword("Pyramids", 49, volume(5, 5)),
    keyword("BoundingBox", 50, Rows::Bare),
    keyword("End", 54, Rows::End),
    keyword("Tangents", 59, Rows::Counted),
    keyword("Normals", 60, Rows::Normals),
    keyword("TangentAtVertices", 61, Rows::Counted),
    keyword("SolAtVertices", 62, Rows::Counted),
    keyword("SolAtTriangles", 64, Rows::Counted),
    keyword("SolAtTetrahedra", 66, Rows::Counted),
    keyword("Iterations", 77, Rows::Bare),
    keyword("Time", 78, Rows::Bare),
    keyword("PrismsP2", 86, volume(6, 18)),
    keyword("PyramidsP2", 87, volume(5, 14)),
];

/// Finds a keyword by its name; programs differ in the case of its letters.
fn by_name(name: &[u8]) -> Option<&'static Keyword> {
    KEYWORDS.iter().find(|keyword| keyword.name.as_bytes().eq_ignore_ascii_case(name))
}

fn by_code(code: u32) -> Option<&'static Keyword> {
    KEYWORDS.iter().find(|keyword| keyword.code == code)
}
