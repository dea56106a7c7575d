//! Which format a file has: told by its content first, by its name second.

use crate::{Limits, Model, ReadError, Sidecars, collada, gltf, medit, obj, ply, stl};
use serde::Serialize;

/// How much of a file is looked at.
pub const LOOKED_AT: usize = 4096;

/// A format of models that can be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Format {
    /// Wavefront OBJ.
    Obj,
    /// glTF 2.0, JSON.
    Gltf,
    /// glTF 2.0, binary.
    Glb,
    /// COLLADA.
    Collada,
    /// PLY, ASCII or binary.
    Ply,
    /// STL, ASCII or binary.
    Stl,
    /// Medit, ASCII.
    Medit,
    /// Medit, binary.
    MeditBinary,
}

impl Format {
    /// All of them.
    pub const ALL: [Format; 8] = [
        Format::Obj,
        Format::Gltf,
        Format::Glb,
        Format::Collada,
        Format::Ply,
        Format::Stl,
        Format::Medit,
        Format::MeditBinary,
    ];

    /// As a sentence names it.
    pub fn name(self) -> &'static str {
        match self {
            Format::Obj => "Wavefront OBJ",
            Format::Gltf => "glTF",
            Format::Glb => "binary glTF",
            Format::Collada => "COLLADA",
            Format::Ply => "PLY",
            Format::Stl => "STL",
            Format::Medit => "Medit",
            Format::MeditBinary => "binary Medit",
        }
    }

    /// The usual ending of a file's name, without the dot.
    pub fn extension(self) -> &'static str {
        match self {
            Format::Obj => "obj",
            Format::Gltf => "gltf",
            Format::Glb => "glb",
            Format::Collada => "dae",
            Format::Ply => "ply",
            Format::Stl => "stl",
            Format::Medit => "mesh",
            Format::MeditBinary => "meshb",
        }
    }

    /// What a file named `name` (whose ending decides where the content does not) beginning with `start` is; or what
    /// it is instead, as `a PNG picture` or, of unknown things, `None`.
    ///
    /// `start` is the whole file or at least its first [`LOOKED_AT`] bytes; `size` is that of the whole.
    pub fn detect(start: &[u8], size: u64, name: &str) -> Result<Format, Option<&'static str>> {
        if let Some(format) = by_signature(start, size) {
            return Ok(format);
        }
        if let Some(other) = other_by_signature(start) {
            return Err(Some(other));
        }
        let text = String::from_utf8_lossy(start);
        let text = text.trim_start_matches('\u{feff}').trim_start();
        if text.starts_with('<') {
            // The root may have a prefix, and stand behind a long comment that is cut off here.
            let is_collada = text.contains("COLLADA") || has_extension(name, Format::Collada);
            return if is_collada { Ok(Format::Collada) } else { Err(Some("an XML or HTML file")) };
        }
        if text.starts_with('{') {
            let says_gltf = text.contains("\"asset\"") || has_extension(name, Format::Gltf);
            return if says_gltf { Ok(Format::Gltf) } else { Err(Some("a JSON file that is no glTF")) };
        }
        if first_statement(text).is_some_and(|line| line.starts_with("MeshVersionFormatted")) {
            return Ok(Format::Medit);
        }
        // `solid` is a good name for an object too: an STL goes on with `facet`.
        let lower = text.to_ascii_lowercase();
        if lower.starts_with("solid") && (lower.contains("facet") || lower.contains("endsolid")) {
            return Ok(Format::Stl);
        }
        if !start.contains(&0) && text.lines().any(is_obj_line) {
            return Ok(Format::Obj);
        }
        // The content says nothing: the name does.
        Format::ALL.into_iter().find(|format| has_extension(name, *format)).ok_or(None)
    }

    /// Reads a file of this format; see the module of the same name.
    pub fn read(self, bytes: &[u8], sidecars: &mut dyn Sidecars, limits: &Limits) -> Result<Model, ReadError> {
        match self {
            Format::Obj => obj::read(bytes, sidecars, limits),
            Format::Gltf | Format::Glb => gltf::read(bytes, sidecars, limits),
            Format::Collada => collada::read(bytes, sidecars, limits),
            Format::Ply => ply::read(bytes, sidecars, limits),
            Format::Stl => stl::read(bytes, sidecars, limits),
            Format::Medit | Format::MeditBinary => medit::read(bytes, sidecars, limits),
        }
    }
}

fn has_extension(name: &str, format: Format) -> bool {
    let name = name.to_ascii_lowercase();
    let name = name.strip_suffix(".gz").or_else(|| name.strip_suffix(".zst")).unwrap_or(&name);
    name.strip_suffix(format.extension()).is_some_and(|rest| rest.ends_with('.'))
}

fn by_signature(start: &[u8], size: u64) -> Option<Format> {
    let code = |at: usize| start.get(at..at + 4).map(|b| [b[0], b[1], b[2], b[3]]);
    if start.starts_with(b"glTF") {
        return Some(Format::Glb);
    }
    if start.starts_with(b"ply\n") || start.starts_with(b"ply\r") {
        return Some(Format::Ply);
    }
    // The code 1 in either byte order, then the version.
    if matches!(code(0), Some([1, 0, 0, 0] | [0, 0, 0, 1]))
        && matches!(code(4), Some([1..=4, 0, 0, 0] | [0, 0, 0, 1..=4]))
    {
        return Some(Format::MeditBinary);
    }
    // A header of 80 bytes that may say anything, the number of triangles, 50 bytes for each.
    let triangles = u64::from(u32::from_le_bytes(code(80)?));
    (size == 84 + 50 * triangles).then_some(Format::Stl)
}

/// Formats that are known by their first bytes and are no models that can be read.
fn other_by_signature(start: &[u8]) -> Option<&'static str> {
    const SIGNATURES: &[(&[u8], &str)] = &[
        (b"BLENDER", "a Blender file (export it as OBJ or glTF)"),
        (b"Kaydara FBX", "an FBX model (export it as OBJ or glTF)"),
        (b"\x89PNG", "a PNG picture"),
        (b"\xff\xd8\xff", "a JPEG picture"),
        (b"GIF8", "a GIF picture"),
        (b"PK\x03\x04", "a ZIP archive (unpack it first)"),
        (b"BZh", "compressed with bzip2 (unpack it first)"),
        (b"\xfd7zXZ", "compressed with xz (unpack it first)"),
        (b"%PDF", "a PDF document"),
        (b"\x7fELF", "a program"),
        (b"\xff\xfe", "text in UTF-16 (save it as UTF-8)"),
        (b"\xfe\xff", "text in UTF-16 (save it as UTF-8)"),
    ];
    SIGNATURES.iter().find(|(signature, _)| start.starts_with(signature)).map(|(_, what)| *what)
}

/// The first line that is neither empty nor a comment (`#`).
fn first_statement(text: &str) -> Option<&str> {
    text.lines().map(str::trim).find(|line| !line.is_empty() && !line.starts_with('#'))
}

fn is_obj_line(line: &str) -> bool {
    let mut words = line.split_whitespace();
    let number = |w: Option<&str>| w.is_some_and(|w| w.parse::<f64>().is_ok());
    match words.next() {
        Some("v" | "vn" | "vt") => number(words.next()),
        Some("f") => words.next().is_some_and(|w| w.starts_with(|c: char| c.is_ascii_digit() || c == '-')),
        Some("mtllib" | "usemtl" | "o" | "g") => words.next().is_some_and(|w| w != "="),
        _ => false,
    }
}
