//! STL (3D Systems, 1989, "StereoLithography Interface Specification"), ASCII and binary.
//!
//! An STL file is a triangle soup: each facet has its own three corners and one normal. The mesh shares a vertex
//! between corners of facets with the same position and the same normal (and colour): a cube has 24 vertices, not 36.
//! It is drawn flat, as in the file; [`crate::normals::make_averaged`] and [`crate::topology`] compare positions and
//! thus find the neighbours again.
//!
//! - Normals are those in the file if they are within 10 degrees of the one given by the winding of the corners
//!   (counter-clockwise seen from outside); otherwise that of the corners, which is counted in a diagnostic. The
//!   specification requires both to agree; where they do not, programs that slice or light the model have used the
//!   corners.
//! - Colours: bytes 81 and 82 after a binary facet, in either of two dialects. If the header has `COLOR=` (Materialise
//!   Magics) they are red, green, blue from the lowest bit on, and bit 15 means "the colour of the header"; otherwise
//!   (VisCAM, SolidView) blue, green, red, and bit 15 means "has a colour". They are interpreted as sRGB.
//! - Each `solid` of an ASCII file is a part with its name.

mod ascii;
mod binary;
mod build;

use crate::encoding::{read_as_utf8, start_as_utf8};
use crate::report::Reports;
use crate::tally::Tally;
use crate::{Limits, Material, Model, ReadError, Sidecars};

/// Triangles as they are in the file.
#[derive(Default)]
struct Facets {
    /// Three for each facet.
    corners: Vec<[f32; 3]>,
    /// The written normal of each facet.
    normals: Vec<[f32; 3]>,
    /// The linear colour of each facet, or empty.
    colors: Vec<[f32; 4]>,
    /// The name of each solid, and its first facet.
    solids: Vec<(String, usize)>,
    /// Facets left out because of a corner that is not finite.
    not_finite: Tally,
    contents: Vec<(String, u64)>,
    material: Material,
}

impl Facets {
    fn count(&self) -> usize {
        self.normals.len()
    }

    /// Adds a facet, if it can be drawn. `place` describes it for messages.
    #[inline]
    fn add(
        &mut self,
        normal: [f32; 3],
        corners: [[f32; 3]; 3],
        line: Option<u64>,
        place: impl FnOnce() -> String,
    ) -> bool {
        if !corners.iter().flatten().all(|c| c.is_finite()) {
            self.not_finite.add(line, place);
            return false;
        }
        self.corners.extend(corners);
        self.normals.push(normal);
        true
    }
}

/// Reads an STL file. It refers to no other files.
///
/// Errors: a number that cannot be read, fewer binary facets than declared, no facets, more data than `limits` allow.
/// Other problems become diagnostics.
pub fn read(bytes: &[u8], sidecars: &mut dyn Sidecars, limits: &Limits) -> Result<Model, ReadError> {
    let _ = sidecars;
    if is_text(bytes) {
        return read_as_utf8(bytes, |text| model(limits, |reports| ascii::read(text, limits, reports)));
    }
    model(limits, |reports| binary::read(bytes, limits, reports))
}

/// Builds the model from the facets that `read` returns.
fn model(limits: &Limits, read: impl FnOnce(&mut Reports) -> Result<Facets, ReadError>) -> Result<Model, ReadError> {
    let mut reports = Reports::default();
    let facets = read(&mut reports)?;
    facets.not_finite.report(crate::Severity::Warning, &mut reports, |tally| {
        let facets = tally.counted("facet has", "facets have");
        format!("{facets} a corner that is not finite (the first is {}): left out", tally.first)
    });
    if facets.count() == 0 {
        let why = reports.first().map(|first| format!("; {}", first.message)).unwrap_or_default();
        return Err(ReadError::new(format!("contains no facets: nothing to draw{why}")));
    }
    build::model(facets, limits, reports)
}

/// Whether the file is text: it begins with `solid` (or `facet`) as text does, and its size is not that of a binary
/// file with its number of facets. (Many programs also begin the free text of binary files with `solid`.)
fn is_text(bytes: &[u8]) -> bool {
    const ENOUGH: usize = 1024;
    // Unless the number of facets exceeds 2^24 it contains a zero byte, which text does not.
    if binary::has_exact_size(bytes) {
        return false;
    }
    let start = start_as_utf8(bytes, ENOUGH);
    let text = start.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(&start).trim_ascii_start();
    let begins = |word: &[u8]| text.get(..word.len()).is_some_and(|start| start.eq_ignore_ascii_case(word));
    (begins(b"solid") || begins(b"facet")) && !start.contains(&0)
}
