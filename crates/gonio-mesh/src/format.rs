//! Detects the format of a file by its content, or by its name where the content does not decide.

use crate::{Limits, Model, ReadError, Sidecars, collada, encoding, gltf, medit, obj, ply, stl};
use memchr::{memchr2, memmem};
use serde::Serialize;
use std::borrow::Cow;

/// Length of the text that is searched for statements of a format, in bytes.
const SEARCHED: usize = 4096;

/// A model format that can be read.
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
    /// All formats.
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

    /// Returns the name of the format for messages.
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

    /// Returns the usual file name extension, without the dot.
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

    /// Detects the format of a file with this content and name. Otherwise returns a description of the file, such as `a
    /// PNG image`, or `None` if it is unknown.
    ///
    /// The content has priority over the name: XML is COLLADA by its root element, JSON is glTF if its outermost object
    /// has one of glTF's keys. The file name extension decides for text without a known statement, for XML that ends
    /// before its root, and for JSON, which is then not searched. Only the search in JSON may go through a whole file;
    /// of other files the kilobytes after the initial comments are examined.
    pub fn detect(content: &[u8], name: &str) -> Result<Format, Option<&'static str>> {
        if let Some(format) = by_signature(content) {
            return Ok(format);
        }
        if let Some(other) = other_by_signature(content) {
            return Err(Some(other));
        }
        let named = Format::ALL.into_iter().find(|format| has_extension(name, *format));
        by_text(without_blanks(&encoding::to_utf8(content).bytes), named)
    }

    /// Reads a file of this format; see the module with the same name.
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

/// Skips a UTF-8 byte order mark and blanks.
fn without_blanks(text: &[u8]) -> &[u8] {
    text.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(text).trim_ascii_start()
}

/// Returns the start of a UTF-8 text after initial blanks and comment lines (`#`): enough to detect the format.
pub fn start_behind_comments(text: &[u8]) -> Cow<'_, str> {
    let mut rest = without_blanks(text);
    while rest.starts_with(b"#") {
        let end = memchr2(b'\n', b'\r', rest).unwrap_or(rest.len());
        rest = rest[end..].trim_ascii_start();
    }
    String::from_utf8_lossy(&rest[..rest.len().min(SEARCHED)])
}

/// Detects the format of UTF-8 text that begins without blanks; `named` is the format by the file's name.
fn by_text(text: &[u8], named: Option<Format>) -> Result<Format, Option<&'static str>> {
    if text.strip_prefix(b"ply").is_some_and(|rest| rest.first().is_none_or(u8::is_ascii_whitespace)) {
        return Ok(Format::Ply);
    }
    if text.starts_with(b"<") {
        let is_collada = root_name(text).map_or(named == Some(Format::Collada), |root| root == b"COLLADA");
        return if is_collada { Ok(Format::Collada) } else { Err(Some("an XML or HTML file")) };
    }
    if text.starts_with(b"{") {
        let is_gltf = named == Some(Format::Gltf) || is_gltf(text);
        return if is_gltf { Ok(Format::Gltf) } else { Err(Some("a JSON file that is not glTF")) };
    }
    let start = start_behind_comments(text);
    let lower = start.to_ascii_lowercase();
    if lower.starts_with("meshversionformatted") {
        return Ok(Format::Medit);
    }
    // An object may be called `solid` too: in an STL file `facet` follows.
    if lower.starts_with("solid") && (lower.contains("facet") || lower.contains("endsolid")) {
        return Ok(Format::Stl);
    }
    if !start.contains('\0') && start.lines().any(is_obj_line) {
        return Ok(Format::Obj);
    }
    named.ok_or(None)
}

fn by_signature(content: &[u8]) -> Option<Format> {
    let code = |at: usize| content.get(at..at + 4).map(|b| [b[0], b[1], b[2], b[3]]);
    if content.starts_with(b"glTF") {
        return Some(Format::Glb);
    }
    // The code 1 in either byte order, then the version.
    if matches!(code(0), Some([1, 0, 0, 0] | [0, 0, 0, 1]))
        && matches!(code(4), Some([1..=4, 0, 0, 0] | [0, 0, 0, 1..=4]))
    {
        return Some(Format::MeditBinary);
    }
    // A header of 80 arbitrary bytes, the number of triangles, 50 bytes for each.
    let triangles = u64::from(u32::from_le_bytes(code(80)?));
    (content.len() as u64 == 84 + 50 * triangles).then_some(Format::Stl)
}

/// Recognises formats that cannot be read by their first bytes.
fn other_by_signature(start: &[u8]) -> Option<&'static str> {
    const SIGNATURES: &[(&[u8], &str)] = &[
        (b"BLENDER", "a Blender file (export it as OBJ or glTF)"),
        (b"Kaydara FBX", "an FBX model (export it as OBJ or glTF)"),
        (b"\0\x10[MeshSerializer", "an Ogre mesh (export it as OBJ or glTF)"),
        (b"\x89PNG", "a PNG image"),
        (b"\xff\xd8\xff", "a JPEG image"),
        (b"GIF8", "a GIF image"),
        (b"PK\x03\x04", "a ZIP archive (unpack it first)"),
        (b"BZh", "compressed with bzip2 (unpack it first)"),
        (b"\xfd7zXZ", "compressed with xz (unpack it first)"),
        (b"%PDF", "a PDF document"),
        (b"\x7fELF", "a program"),
    ];
    SIGNATURES.iter().find(|(signature, _)| start.starts_with(signature)).map(|(_, what)| *what)
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

/// Keys that distinguish a glTF document from other JSON.
const KEYS_OF_GLTF: [&[u8]; 3] = [b"asset", b"accessors", b"bufferViews"];

/// Whether the outermost object of `json`, which begins with its `{`, has one of glTF's keys.
///
/// The document is scanned up to the first such key, which may be the last one, after gigabytes of buffers; this takes
/// no memory. Invalid JSON is scanned as far as possible.
fn is_gltf(json: &[u8]) -> bool {
    let mut depth = 0_usize;
    let mut at = 0;
    while let Some(offset) = json.get(at..).and_then(|rest| rest.iter().position(|byte| is_structure(*byte))) {
        at += offset + 1;
        match json[at - 1] {
            b'{' | b'[' => depth += 1,
            b'}' | b']' if depth <= 1 => return false,
            b'}' | b']' => depth -= 1,
            _ => {
                let Some(end) = end_of_string(json, at) else { return false };
                let is_key = || json[end + 1..].trim_ascii_start().first() == Some(&b':');
                if depth == 1 && KEYS_OF_GLTF.contains(&&json[at..end]) && is_key() {
                    return true;
                }
                at = end + 1;
            }
        }
    }
    false
}

fn is_structure(byte: u8) -> bool {
    matches!(byte, b'{' | b'}' | b'[' | b']' | b'"')
}

/// Returns the position of the `"` that ends the string whose text begins at `at`.
fn end_of_string(json: &[u8], mut at: usize) -> Option<usize> {
    loop {
        at += memchr2(b'"', b'\\', json.get(at..)?)?;
        if json[at] == b'"' {
            return Some(at);
        }
        at += 2;
    }
}

/// Returns the name, without a prefix, of the first element of `xml`, which begins with a `<`; `None` if there is none,
/// or if the prolog does not end.
///
/// The prolog consists of any number of processing instructions, comments and document type declarations of any length
/// (Extensible Markup Language 1.0, section 2.8).
fn root_name(xml: &[u8]) -> Option<&[u8]> {
    let mut rest = xml;
    loop {
        rest = rest.trim_ascii_start();
        rest = if let Some(instruction) = rest.strip_prefix(b"<?") {
            behind(instruction, b"?>")?
        } else if let Some(comment) = rest.strip_prefix(b"<!--") {
            behind(comment, b"-->")?
        } else if let Some(declaration) = rest.strip_prefix(b"<!") {
            behind_declaration(declaration)?
        } else {
            break;
        }
    }
    let name = rest.strip_prefix(b"<")?;
    let end = name.iter().position(|byte| byte.is_ascii_whitespace() || matches!(byte, b'>' | b'/' | b'<'))?;
    let name = &name[..end];
    Some(name.iter().rposition(|byte| *byte == b':').map_or(name, |colon| &name[colon + 1..]))
}

/// Returns the text after the first `end`.
fn behind<'a>(text: &'a [u8], end: &[u8]) -> Option<&'a [u8]> {
    memmem::find(text, end).map(|at| &text[at + end.len()..])
}

/// Returns the text after the `>` of a declaration, which may contain declarations in brackets.
fn behind_declaration(declaration: &[u8]) -> Option<&[u8]> {
    let mut rest = declaration;
    let mut brackets = 0_usize;
    loop {
        let (byte, next) = rest.split_first()?;
        rest = match byte {
            b'>' if brackets == 0 => return Some(next),
            b'[' => {
                brackets += 1;
                next
            }
            b']' => {
                brackets = brackets.saturating_sub(1);
                next
            }
            b'"' | b'\'' => behind(next, &[*byte])?,
            b'<' if next.starts_with(b"!--") => behind(&next[3..], b"-->")?,
            b'<' if next.starts_with(b"?") => behind(next, b"?>")?,
            _ => next,
        };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_keys_of_the_outermost_object_count() {
        let gltf = [
            r#"{"asset": {"version": "2.0"}}"#,
            "{ \"nodes\" : [ { \"name\" : \"}]\\\"\" } ] , \"asset\"\n:\t{} }",
            r#"{"buffers": [{"uri": "data:;base64,AA==\\"}], "x": [[[]], {}], "asset": {}}"#,
            // Truncated or damaged: the reader reports where.
            r#"{"accessors": [{"count": 3"#,
            r#"{"scene": 0, "bufferViews": "#,
        ];
        for json in gltf {
            assert!(is_gltf(json.as_bytes()), "{json}");
        }
        let others = [
            "{}",
            "{",
            r#"{"a": "asset", "asset"}"#,
            r#"{"model": {"asset": {"version": "2.0"}}}"#,
            r#"{"models": [{"asset": 1}]}"#,
            r#"{"a": "\"asset\": 1, \"asset"#,
            r#"{"Asset": 1, "assets": 2}"#,
            r#"{"a": 1} {"asset": 2}"#,
            "{\"asset",
            "{\"a\\",
        ];
        for json in others {
            assert!(!is_gltf(json.as_bytes()), "{json}");
        }
    }

    #[test]
    fn the_root_stands_behind_the_prolog() {
        let long = format!("<!-- {} <COLLADA> -->", "-".repeat(10_000));
        let name = |xml: &str| root_name(xml.as_bytes()).map(|name| String::from_utf8_lossy(name).into_owned());
        let documents = [
            ("<COLLADA xmlns='x'>", "COLLADA"),
            ("<COLLADA>", "COLLADA"),
            ("<c:COLLADA\n>", "COLLADA"),
            ("<svg/>", "svg"),
            ("<?xml version='1.0'?>\n<?style a='>'?> <!-- <svg> --><COLLADA ", "COLLADA"),
            ("<!DOCTYPE html><html>", "html"),
            ("<!DOCTYPE COLLADA SYSTEM 'a>b.dtd'>\n<COLLADA>", "COLLADA"),
            ("<!DOCTYPE a [<!ENTITY b \"]><svg>\"> <!-- ]><svg> ' --> <?c ]> ?>]>\n<COLLADA>", "COLLADA"),
            (&format!("{long}\n<COLLADA>"), "COLLADA"),
        ];
        for (xml, root) in documents {
            assert_eq!(name(xml).as_deref(), Some(root), "{xml}");
        }
        for xml in ["<", "<?xml", "<!-- COLLADA", "<!DOCTYPE a [ <b> ", "<COLLADA", "text <COLLADA>"] {
            assert_eq!(name(xml), None, "{xml}");
        }
    }
}
