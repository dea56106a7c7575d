//! Wavefront OBJ, as its appendix B1 ("Object Files", Alias|Wavefront Advanced Visualizer manual) and two decades of
//! exporters define it.
//!
//! A file is read in two passes over its bytes. The first one reads the attributes of vertices (`attributes`) and
//! remembers the ranges of the other statements. The second one reads those, merges equal corners into vertices and
//! triangulates polygons (`faces`, `vertices`); it knows all vertices of the file, so indices may refer forward. Both
//! work on pieces of the file in parallel (`pieces`); the results are joined in file order (`join`) and assembled into
//! a mesh (`assemble`), which does not depend on the number of pieces.
//!
//! Lines in plain form take a fast path (`fast_path`, `plain_face`, `scan`) with the same result as reading byte by
//! byte.

mod assemble;
mod attributes;
mod faces;
mod fast_path;
mod materials;
mod parts;
mod pieces;
mod plain_face;
mod scan;
mod statistics;
#[cfg(test)]
mod tests;
mod triangles;
mod vertices;

use crate::diagnostic::Reports;
use crate::encoding::read_as_utf8;
use crate::{Diagnostic, FilePlace, Limits, Model, ReadError, Sidecars};
pub(crate) use attributes::not_finite_behind_position;
use attributes::{Attributes, Segment};
use faces::Faces;
use gonio_light::color::srgb_decode_f32;
use gonio_threads::HAS_THREADS;
use gonio_threads::prelude::*;
use materials::MaterialTable;
use parts::Parts;
pub(crate) use parts::SmoothingGroup;
use pieces::Plan;
use statistics::Statistics;
use std::mem;
use std::ops::Range;
use triangles::Triangles;
use vertices::{CornerAttributes, Vertices};

/// Reads an OBJ file; its material libraries are requested from `sidecars`.
///
/// Everything that can be drawn is drawn: a face with an out-of-range vertex index is left out with a warning, an
/// out-of-range index of a texture coordinate or normal counts as missing. Errors are: a number that cannot be read, a
/// coordinate that is not finite, no triangles, a file of another format, more data than `limits` allow, a face of more
/// than 4,194,304 corners.
///
/// - Vertices are in the order of the positions (`v`) that faces use; if a position has several texture coordinates or
///   normals, all but the first used come at the end, in the order of their first use.
/// - Parts are spans of faces with one name (the latest `o` or `g`) and material. Materials are those of all libraries;
///   the default material comes first if a face needs it.
/// - Normals are of unit length, or zero if the file has none for a corner ([`crate::normals::complete`] computes
///   them). Non-finite numbers of a normal, a texture coordinate or a colour are replaced by 0.
/// - Vertex colours are interpreted as sRGB from 0 to 1, as Blender and MeshLab write them (if larger: from 0 to 255).
///
/// Large files are read on as many threads as rayon's current pool has, on the web on one; the result does not depend on their number.
pub fn read(bytes: &[u8], sidecars: &mut dyn Sidecars, limits: &Limits) -> Result<Model, ReadError> {
    read_as_utf8(bytes, |text| read_with(text, sidecars, limits, Plan::for_size(text.len())))
}

fn read_with(bytes: &[u8], sidecars: &mut dyn Sidecars, limits: &Limits, plan: Plan) -> Result<Model, ReadError> {
    refuse_other_formats(bytes)?;
    let mut attributes = read_attributes(bytes, plan);
    let SecondPass { mut reports, statistics, mut parts, libraries, vertices, indices } =
        read_second_pass(bytes, &mut attributes, limits, plan)?;
    let contents = statistics::list(&attributes, &statistics);
    let vertex_count = attributes.positions.len() as u64;
    statistics::report(&attributes, &statistics, &mut reports);
    if statistics.understood() + attributes.counts().iter().sum::<u64>() == 0 {
        return Err(nothing_understood(&reports));
    }
    decode_colors(&mut attributes.colors, &mut reports);
    let mut materials = MaterialTable::read(&libraries, sidecars, &mut reports);
    parts.find_materials(&mut materials, &mut reports);
    if indices.is_empty() {
        return Err(nothing_to_draw(vertex_count, statistics.face_count(), &reports));
    }
    let mut mesh = assemble::mesh(attributes, vertices, indices, limits)?;
    let sidecars = materials.take_sidecars();
    let (materials, offset) = materials.finish();
    parts.finish(&mut mesh, offset);
    Ok(Model { mesh, materials, contents, sidecars, diagnostics: reports.finish(), ..Model::default() })
}

fn read_attributes(bytes: &[u8], plan: Plan) -> Attributes {
    let parse = |piece: Range<usize>| Attributes::parse(bytes, piece, plan.fast_path);
    if !HAS_THREADS {
        return parse(0..bytes.len());
    }
    let pieces = pieces::split(bytes, plan.pieces);
    pieces::attributes(match pieces.as_slice() {
        [all] => vec![parse(all.clone())],
        _ => pieces.into_par_iter().map(parse).collect(),
    })
}

/// The results of the second pass, in file order.
struct SecondPass {
    reports: Reports,
    statistics: Statistics,
    parts: Parts,
    libraries: Vec<(u64, String)>,
    vertices: Vertices,
    indices: Vec<u32>,
}

/// The second pass. If both passes have an error, the first one in the file is returned.
fn read_second_pass(
    bytes: &[u8],
    attributes: &mut Attributes,
    limits: &Limits,
    plan: Plan,
) -> Result<SecondPass, ReadError> {
    let reports = mem::take(&mut attributes.reports);
    let segments = mem::take(&mut attributes.segments);
    let first_error = attributes.error.take().or_else(|| too_many(attributes));
    let stretches = if HAS_THREADS { pieces::stretches(&segments, plan.stretches) } else { vec![segments.as_slice()] };
    let most = limits.max_triangles;
    let parse = |stretch: &[Segment], room| Faces::read(bytes, attributes, stretch, room, most, plan.fast_path);
    let mut indices = Vec::new();
    let read: Result<Vec<Faces<'_>>, ReadError> = match stretches.as_slice() {
        [all] => parse(all, Triangles::of_all(triangles::likely_count(all))).map(|faces| vec![faces]),
        several if HAS_THREADS => {
            indices = vec![0; 3 * triangles::likely_count(&segments)];
            let rooms = triangles::rooms(&mut indices, several);
            let read: Vec<_> = several.par_iter().zip(rooms).map(|(stretch, room)| parse(stretch, room)).collect();
            read.into_iter().collect()
        }
        // Without threads there is one stretch.
        _ => Ok(Vec::new()),
    };
    let faces = match (read, first_error) {
        // The second pass stopped where the first one failed.
        (Err(error), _) if error.place.line.is_some() => return Err(error),
        (_, Some(error)) | (Err(error), None) => return Err(error),
        // There are too many kinds of unknown statements to count them in pieces.
        (Ok(faces), None)
            if HAS_THREADS && faces.len() > 1 && faces.iter().any(|faces| faces.statistics.tallies.is_full) =>
        {
            drop(faces);
            vec![parse(&segments, Triangles::of_all(0))?]
        }
        (Ok(faces), None) => faces,
    };
    let is_one = faces.len() == 1;
    let (rest, parts) = SecondPass::join(reports, faces)?;
    let indices = triangles::join(if is_one { Vec::new() } else { indices }, &stretches, parts);
    Ok(SecondPass { indices, ..rest })
}

/// For each range the used part of its room for indices, and the indices that did not fit.
type Leftovers = Vec<(usize, Vec<u32>)>;

impl SecondPass {
    /// Joins everything except the triangles, which are not yet in one place.
    fn join(reports: Reports, stretches: Vec<Faces<'_>>) -> Result<(Self, Leftovers), ReadError> {
        let (mut statistics, mut parts, mut libraries, mut all_reports) =
            (Statistics::default(), Parts::default(), Vec::new(), reports);
        let mut pieces = Vec::with_capacity(stretches.len());
        for stretch in stretches {
            let Faces { vertices, triangles, spans, libraries: more, statistics: more_statistics, reports, .. } =
                stretch;
            parts.append(spans, triangles.count());
            libraries.extend(more);
            statistics.append(more_statistics);
            all_reports.append(reports, 0);
            pieces.push((vertices, triangles));
        }
        let vertices = pieces::vertices(&mut pieces)?;
        let triangles = pieces.into_iter().map(|(_, triangles)| triangles.finish()).collect();
        let second_pass =
            SecondPass { reports: all_reports, statistics, parts, libraries, vertices, indices: Vec::new() };
        Ok((second_pass, triangles))
    }
}

/// Creates the error for too many attributes of a kind.
fn too_many(attributes: &Attributes) -> Option<ReadError> {
    let limits = [
        ("v", u64::from(u32::MAX) - 1),
        ("vt", CornerAttributes::MOST_TEX_COORDS),
        ("vn", CornerAttributes::MOST_NORMALS),
    ];
    let counts = attributes.counts();
    let ((keyword, most), _) = limits.into_iter().zip(counts).find(|((_, most), count)| count > most)?;
    Some(ReadError::new(format!("contains more than {most} {keyword} statements, which is the limit")))
}

/// Rejects a file that is certainly not an OBJ.
fn refuse_other_formats(bytes: &[u8]) -> Result<(), ReadError> {
    const SIGNATURES: [(&[u8], &str); 9] = [
        (b"glTF", "a binary glTF file"),
        (b"ply\n", "a PLY file"),
        (b"ply\r", "a PLY file"),
        (b"\x89PNG", "a PNG image"),
        (b"\xFF\xD8\xFF", "a JPEG image"),
        (b"PK\x03\x04", "a ZIP archive: unpack it"),
        (b"\x1F\x8B", "compressed with gzip: unpack it"),
        (b"BLENDER", "a Blender file: export it as OBJ"),
        (b"Kaydara FBX", "an FBX file"),
    ];
    const ENOUGH: usize = 1 << 16;
    if bytes.trim_ascii().is_empty() {
        return Err(ReadError::new("the file is empty"));
    }
    if let Some((_, what)) = SIGNATURES.iter().find(|(signature, _)| bytes.starts_with(signature)) {
        return Err(ReadError::new(format!("this is not an OBJ file: it is {what}")));
    }
    if let Some(at) = bytes[..bytes.len().min(ENOUGH)].iter().position(|&byte| byte == 0) {
        return Err(ReadError::new(format!("this is not an OBJ file: it is binary (byte {} is 0)", at + 1)));
    }
    Ok(())
}

#[cold]
fn nothing_understood(reports: &Reports) -> ReadError {
    let found = match reports.first() {
        Some(first) => format!("the first problem: {}", first.message),
        None => "it contains only comments".to_owned(),
    };
    ReadError::new(format!("this is not an OBJ file: it contains no OBJ statement; {found}"))
}

#[cold]
fn nothing_to_draw(vertices: u64, faces: u64, reports: &Reports) -> ReadError {
    let plural = |count: u64, one: &str, many: &str| format!("{count} {}", if count == 1 { one } else { many });
    let counts = format!("{}, {}", plural(vertices, "vertex", "vertices"), plural(faces, "face", "faces"));
    // Diagnostics of its libraries do not explain it.
    let reason = match reports.first().filter(|first| first.place.file.is_none()) {
        Some(Diagnostic { message, place: FilePlace { line: Some(line), .. }, .. }) => {
            format!("; line {line}: {message}")
        }
        Some(first) => format!("; {}", first.message),
        None => String::new(),
    };
    ReadError::new(format!("contains no triangles ({counts}): nothing to draw{reason}"))
}

/// Converts from sRGB to linear, in place.
fn decode_colors(colors: &mut [[f32; 3]], reports: &mut Reports) {
    let largest = colors.iter().flatten().fold(0.0, |a: f32, &b| a.max(b));
    let scale = if largest > 1.0 && largest <= 255.0 { 1.0 / 255.0 } else { 1.0 };
    if scale != 1.0 {
        let message = format!("vertex colors reach {largest}: treated as 0 to 255");
        reports.push(u64::MAX, Diagnostic::note(message));
    }
    for value in colors.iter_mut().flatten() {
        *value = srgb_decode_f32(*value * scale);
    }
}
