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

use crate::diagnostic::{Reports, Tally};
use crate::encoding::{read_as_utf8, start_as_utf8};
use crate::input::too_many_vertices;
use crate::weld::{self, Joiner};
use crate::{Limits, Material, Mesh, Model, NormalSource, Part, ReadError, Severity, Sidecars};
use glam::DVec3;

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
        let reason = reports.first().map(|first| format!("; {}", first.message)).unwrap_or_default();
        return Err(ReadError::new(format!("contains no facets: nothing to draw{reason}")));
    }
    build(facets, limits, reports)
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

/// The cosine of the largest angle between a normal and that of the corners: 10 degrees. Six digits are more exact, and
/// so are the normals of all but the thinnest triangles.
const AGREES: f64 = 0.985;

/// Builds an indexed mesh with a normal for each triangle.
fn build(mut facets: Facets, limits: &Limits, mut reports: Reports) -> Result<Model, ReadError> {
    let (normals, normal_source) = normals(&facets, &mut reports);
    let (places, place_count) = weld::places(&facets.corners);
    let mut joiner = Joiner::new(place_count);
    let mut mesh = Mesh { normal_source, parts: parts(&facets), ..Mesh::default() };
    mesh.indices.reserve_exact(facets.corners.len());
    for (corner, (&place, &position)) in places.iter().zip(&facets.corners).enumerate() {
        let normal = normals[corner / 3];
        let color = facets.colors.get(corner / 3);
        let [x, y, z] = normal.map(f32::to_bits);
        let [r, g, b, _] = color.copied().unwrap_or_default().map(f32::to_bits);
        let (vertex, is_new) = joiner.vertex(place, [x, y, z, r, g, b]);
        if is_new {
            mesh.positions.push(position);
            mesh.normals.push(normal);
            mesh.colors.extend(color);
            if mesh.positions.len() as u64 > limits.max_vertices.min(u64::from(u32::MAX)) {
                let most = limits.max_vertices.min(u64::from(u32::MAX));
                return Err(too_many_vertices(most));
            }
        }
        mesh.indices.push(vertex);
    }
    let mut contents = std::mem::take(&mut facets.contents);
    contents.push(("distinct positions".to_owned(), place_count as u64));
    Ok(Model { mesh, materials: vec![facets.material], contents, diagnostics: reports.finish(), ..Model::default() })
}

/// Returns the spans of facets with one name.
fn parts(facets: &Facets) -> Vec<Part> {
    let mut parts: Vec<Part> = Vec::new();
    let ends = facets.solids.iter().skip(1).map(|solid| solid.1).chain([facets.count()]);
    // Facets before the first `solid`.
    let before = facets.solids.first().map_or(facets.count(), |solid| solid.1);
    let nameless = (String::new(), 0);
    let solids = facets.solids.iter().zip(ends);
    for ((name, first_triangle), end) in [(&nameless, before)].into_iter().chain(solids) {
        let triangle_count = end - first_triangle;
        match parts.last_mut() {
            _ if triangle_count == 0 => {}
            Some(last) if last.name == *name => last.triangle_count += triangle_count,
            _ => {
                let (name, first_triangle) = (name.clone(), *first_triangle);
                parts.push(Part { name, material: 0, first_triangle, triangle_count });
            }
        }
    }
    parts
}

/// Returns one normal for each facet: the written one, or that of its corners.
fn normals(facets: &Facets, reports: &mut Reports) -> (Vec<[f32; 3]>, NormalSource) {
    let mut anomalies = Anomalies::default();
    let normals = facets.corners.chunks_exact(3).zip(&facets.normals).enumerate();
    let normals: Vec<[f32; 3]> =
        normals.map(|(i, (corners, &written))| anomalies.normal(i, corners, written)).collect();
    let computed = anomalies.absent.count + anomalies.against.count + anomalies.off.count;
    anomalies.report(facets.count(), reports);
    (normals, if computed == 0 { NormalSource::File } else { NormalSource::Flat })
}

#[derive(Default)]
struct Anomalies {
    absent: Tally,
    against: Tally,
    off: Tally,
    no_area: Tally,
}

impl Anomalies {
    fn normal(&mut self, facet: usize, corners: &[[f32; 3]], written: [f32; 3]) -> [f32; 3] {
        let place = || format!("facet {facet}");
        // A vector that is zero, infinite or NaN cannot be normalized.
        let written = DVec3::from(written.map(f64::from)).try_normalize();
        let computed = match corners {
            [a, b, c] => unit_normal([a, b, c].map(|&corner| DVec3::from(corner.map(f64::from)))),
            _ => None,
        };
        let normal = match (written, computed) {
            (None, None) => {
                self.no_area.add(None, place);
                return [0.0; 3];
            }
            (Some(written), None) => written,
            (None, Some(computed)) => {
                self.absent.add(None, place);
                computed
            }
            (Some(written), Some(computed)) => {
                let cosine = written.dot(computed);
                if cosine >= AGREES {
                    written
                } else {
                    (if cosine < 0.0 { &mut self.against } else { &mut self.off }).add(None, place);
                    computed
                }
            }
        };
        // Without -0, which would separate vertices.
        normal.as_vec3().to_array().map(|c| c + 0.0)
    }

    fn report(&self, count: usize, reports: &mut Reports) {
        let computed = "computed from the corners";
        self.absent.report(Severity::Note, reports, |tally| {
            format!("{} of {count} facets have no normal (the first is {}): {computed}", tally.count, tally.first)
        });
        self.against.report(Severity::Warning, reports, |tally| {
            let what = "normals point against the winding of their corners";
            format!("{} of {count} {what} (the first is that of {}): {computed}", tally.count, tally.first)
        });
        self.off.report(Severity::Warning, reports, |tally| {
            let what = "normals lie more than 10 degrees off their facet";
            format!("{} of {count} {what} (the first is that of {}): {computed}", tally.count, tally.first)
        });
        self.no_area.report(Severity::Warning, reports, |tally| {
            let facets = tally.counted("facet has", "facets have");
            format!("{facets} neither an area nor a normal (the first is {})", tally.first)
        });
    }
}

/// Returns `None` if the triangle has no area other than the rounding error of parallel edges.
fn unit_normal([a, b, c]: [DVec3; 3]) -> Option<DVec3> {
    let (ab, ac) = (b - a, c - a);
    let cross = ab.cross(ac);
    let is_degenerate = cross.length_squared() <= 1e-28 * ab.length_squared() * ac.length_squared();
    if is_degenerate { None } else { cross.try_normalize() }
}
