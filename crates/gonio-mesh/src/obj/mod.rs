//! Wavefront OBJ, as its appendix B1 ("Object Files", Alias|Wavefront Advanced Visualizer manual) and two decades of
//! exporters define it.
//!
//! One pass over the bytes turns statements into arrays (`parse`); a second one over the faces merges equal corners
//! into vertices and cuts polygons into triangles (`build`).

mod build;
mod faces;
mod materials;
mod parse;

use crate::{Limits, Model, ReadError, Sidecars};
use materials::MaterialTable;
use parse::Statements;

/// Reads an OBJ file; its material libraries are asked of `sidecars`.
///
/// What can be drawn is drawn: a face that points at no vertex is left out with a warning, an index of a texture
/// coordinate or normal that points at nothing counts as missing. Errors are: a number that cannot be read, a
/// coordinate that is not finite, no triangle at all, a file that is none of this format, more than `limits` allow.
///
/// - Parts are runs of faces with one name (the latest `o` or `g`) and material. Materials are those of all libraries;
///   the default material comes first where a face needs it.
/// - Normals are of unit length, or zero where the file has none for a corner ([`crate::normals::complete`] mends it).
///   A normal's or texture coordinate's number that is not finite counts as 0.
/// - Vertex colours are taken for sRGB from 0 to 1, as Blender and MeshLab write them (beyond 1: from 0 to 255).
pub fn read(bytes: &[u8], sidecars: &mut dyn Sidecars, limits: &Limits) -> Result<Model, ReadError> {
    refuse_other_formats(bytes)?;
    let mut statements = Statements::parse(bytes)?;
    if statements.understood == 0 {
        return Err(nothing_understood(&statements));
    }
    decode_colors(&mut statements);
    let mut materials = MaterialTable::read(&statements.libraries, sidecars, &mut statements.reports);
    let mut mesh = build::mesh(&mut statements, &mut materials, limits)?;
    if mesh.indices.is_empty() {
        return Err(nothing_to_draw(&statements));
    }
    let (materials, offset) = materials.finish();
    for part in &mut mesh.parts {
        part.material -= offset;
    }
    Ok(Model { mesh, materials, diagnostics: statements.reports.finish() })
}

/// Says at once what a file is that is certainly no OBJ.
fn refuse_other_formats(bytes: &[u8]) -> Result<(), ReadError> {
    const SIGNATURES: [(&[u8], &str); 9] = [
        (b"glTF", "a binary glTF file"),
        (b"ply\n", "a PLY file"),
        (b"ply\r", "a PLY file"),
        (b"\x89PNG", "a PNG picture"),
        (b"\xFF\xD8\xFF", "a JPEG picture"),
        (b"PK\x03\x04", "a ZIP archive: unpack it"),
        (b"\x1F\x8B", "compressed with gzip: unpack it"),
        (b"BLENDER", "a Blender file: export it as OBJ"),
        (b"Kaydara FBX", "an FBX file"),
    ];
    const ENOUGH: usize = 1 << 16;
    if bytes.trim_ascii().is_empty() {
        return Err(ReadError::new("the file is empty"));
    }
    if bytes.starts_with(b"\xFF\xFE") || bytes.starts_with(b"\xFE\xFF") {
        return Err(ReadError::new("this is text in UTF-16: save it as UTF-8"));
    }
    if let Some((_, what)) = SIGNATURES.iter().find(|(signature, _)| bytes.starts_with(signature)) {
        return Err(ReadError::new(format!("this is no OBJ file, it is {what}")));
    }
    if let Some(at) = bytes[..bytes.len().min(ENOUGH)].iter().position(|&byte| byte == 0) {
        return Err(ReadError::new(format!("this is no OBJ file: it is binary (byte {} is 0)", at + 1)));
    }
    Ok(())
}

#[cold]
fn nothing_understood(statements: &Statements) -> ReadError {
    let found = match statements.reports.first() {
        Some(first) => format!("the first thing in it: {}", first.message),
        None => "it holds nothing but comments".to_owned(),
    };
    ReadError::new(format!("this is no OBJ file: no statement of that format is in it; {found}"))
}

#[cold]
fn nothing_to_draw(statements: &Statements) -> ReadError {
    let (vertices, faces) = (statements.positions.len(), statements.faces.count);
    let plural = |count: u64, one: &str, many: &str| format!("{count} {}", if count == 1 { one } else { many });
    let counts = format!("{}, {}", plural(vertices as u64, "vertex", "vertices"), plural(faces, "face", "faces"));
    let why = match statements.reports.first() {
        Some(first) => match first.line {
            Some(line) if first.file.is_none() => format!("; line {line}: {}", first.message),
            _ => format!("; {}", first.message),
        },
        None => String::new(),
    };
    ReadError::new(format!("holds no triangles ({counts}): nothing to draw{why}"))
}

/// From sRGB to linear, in place.
fn decode_colors(statements: &mut Statements) {
    let largest = statements.colors.iter().flatten().fold(0.0, |a: f32, &b| a.max(b));
    let scale = if largest > 1.0 && largest <= 255.0 { 1.0 / 255.0 } else { 1.0 };
    if scale != 1.0 {
        let message = format!("vertex colors reach {largest}: taken as from 0 to 255");
        statements.reports.push(u64::MAX, crate::Diagnostic::note(message));
    }
    for value in statements.colors.iter_mut().flatten() {
        *value = linear_from_srgb((*value * scale).clamp(0.0, 1.0));
    }
}

/// IEC 61966-2-1, from the encoded value in [0, 1].
fn linear_from_srgb(encoded: f32) -> f32 {
    if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
}
