//! What an input is: told by its content first, then by its name.

use std::path::Path;

/// How much of a file is looked at.
pub(crate) const LOOKED_AT: usize = 4096;

/// What can be read now.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum InputKind {
    Scene,
    Obj,
}

/// What the beginning of a file named `name` shows, or why it cannot be read.
pub(crate) fn tell(start: &[u8], name: &Path) -> Result<InputKind, String> {
    const READABLE: &str = "Wavefront models (.obj) and scene files (.toml) can be read now";
    if start.is_empty() {
        return Err(format!("the file is empty; {READABLE}"));
    }
    if let Some(other) = other_format(start) {
        return Err(format!("this is {other}; {READABLE}"));
    }
    if start.contains(&0) {
        return Err(format!("this is binary data; {READABLE}"));
    }
    let extension = name.extension().and_then(|e| e.to_str()).unwrap_or("").to_ascii_lowercase();
    let text = String::from_utf8_lossy(start);
    let obj = text.lines().any(is_obj_line);
    let toml = text.lines().any(is_toml_line);
    match (obj, toml, extension.as_str()) {
        (_, false, "obj") | (true, false, _) | (true, true, "obj") => Ok(InputKind::Obj),
        (false, _, "toml") | (false, true, _) | (true, true, "toml") => Ok(InputKind::Scene),
        _ => {
            let ending = if extension.is_empty() { String::new() } else { format!(" .{extension}") };
            Err(format!("this{ending} file is of no known kind; {READABLE}"))
        }
    }
}

/// Formats that are known by their first bytes, and that gonio cannot read (yet).
fn other_format(start: &[u8]) -> Option<&'static str> {
    const MAGIC: &[(&[u8], &str)] = &[
        (b"glTF", "a binary glTF model"),
        (b"ply\n", "a PLY model"),
        (b"ply\r", "a PLY model"),
        (b"solid ", "an STL model"),
        (b"MeshVersionFormatted", "a Medit mesh"),
        (b"BLENDER", "a Blender file (export it as Wavefront OBJ)"),
        (b"Kaydara FBX", "an FBX model (export it as Wavefront OBJ)"),
        (b"\x89PNG", "a PNG picture, not a model"),
        (b"\xff\xd8\xff", "a JPEG picture, not a model"),
        (b"GIF8", "a GIF picture, not a model"),
        (b"PK\x03\x04", "a ZIP archive (unpack it first)"),
    ];
    if let Some((_, what)) = MAGIC.iter().find(|(magic, _)| start.starts_with(magic)) {
        return Some(what);
    }
    let text = String::from_utf8_lossy(start);
    let text = text.trim_start_matches('\u{feff}').trim_start();
    if text.starts_with('<') {
        return Some(if text.contains("<COLLADA") { "a COLLADA model" } else { "an XML or HTML file" });
    }
    (text.starts_with('{') && text.contains('"')).then_some("a JSON file (glTF, perhaps)")
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

fn is_toml_line(line: &str) -> bool {
    let line = line.trim();
    let word = |s: &str| !s.is_empty() && s.chars().all(|c| c.is_ascii_alphanumeric() || "_-.".contains(c));
    if let Some(rest) = line.strip_prefix('[') {
        return word(rest.trim_start_matches('[').split(']').next().unwrap_or(""));
    }
    line.split_once('=').is_some_and(|(key, _)| word(key.trim()))
}
