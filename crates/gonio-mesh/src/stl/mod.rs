//! STL (3D Systems, 1989, "StereoLithography Interface Specification"), ASCII and binary.
//!
//! An STL file is a soup of triangles: each facet has its own three corners and one normal. The mesh made of it shares
//! a vertex between the corners of facets that have the same position and the same normal (and colour): a cube has 24
//! vertices, not 36. It is drawn flat, as the file says; [`crate::normals::make_averaged`] and [`crate::topology`] go
//! by position and so find the neighbours again.
//!
//! - Normals are the file's, where they lie within 10 degrees of the one that the corners have by their winding
//!   (counter-clockwise seen from outside); else the corners' own, which is counted in a diagnostic. The specification
//!   wants both to agree; where they do not, every program that slices or lights the model has gone by the corners.
//! - Colours: bytes 81 and 82 behind a binary facet, in either of two dialects. Where the header has `COLOR=`
//!   (Materialise Magics) they are red, green, blue from the lowest bit on, and bit 15 stands for "the colour of the
//!   header"; else (VisCAM, SolidView) blue, green, red, and bit 15 for "a colour". They are taken for sRGB.
//! - Each `solid` of an ASCII file is a part by its name.

mod ascii;
mod binary;
mod build;

use crate::encoding::{read_as_utf8, start_as_utf8};
use crate::report::Reports;
use crate::tally::Tally;
use crate::{Limits, Material, Model, ReadError, Sidecars};

/// Triangles as the file has them.
#[derive(Default)]
struct Facets {
    /// Three for each.
    corners: Vec<[f32; 3]>,
    /// As written; of each facet.
    normals: Vec<[f32; 3]>,
    /// Linear, of each facet, or empty.
    colors: Vec<[f32; 4]>,
    /// Each solid's name, and its first facet.
    solids: Vec<(String, usize)>,
    /// Facets left out for a corner that is not finite.
    not_finite: Tally,
    contents: Vec<(String, u64)>,
    material: Material,
}

impl Facets {
    fn count(&self) -> usize {
        self.normals.len()
    }

    /// Adds one, if it can be drawn. `place` says which it is.
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

/// Reads an STL file, which names no other files.
///
/// Errors: a number that cannot be read, fewer binary facets than the file says, no facet at all, more than `limits`
/// allow. Everything else is survived.
pub fn read(bytes: &[u8], sidecars: &mut dyn Sidecars, limits: &Limits) -> Result<Model, ReadError> {
    let _ = sidecars;
    if is_text(bytes) {
        return read_as_utf8(bytes, |text| model(limits, |reports| ascii::read(text, limits, reports)));
    }
    model(limits, |reports| binary::read(bytes, limits, reports))
}

/// The model of the facets that `read` gives.
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

/// Whether the file is text: it begins with `solid` (or `facet`) as text does, and is not as long as a binary file
/// with its number of facets would be. (Many programs begin the free text of binary files with `solid` too.)
fn is_text(bytes: &[u8]) -> bool {
    const ENOUGH: usize = 1024;
    // Only a number of facets beyond 2^24 has no byte 0, which text has not.
    if binary::has_exact_size(bytes) {
        return false;
    }
    let start = start_as_utf8(bytes, ENOUGH);
    let text = start.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(&start).trim_ascii_start();
    let begins = |word: &[u8]| text.get(..word.len()).is_some_and(|start| start.eq_ignore_ascii_case(word));
    (begins(b"solid") || begins(b"facet")) && !start.contains(&0)
}
