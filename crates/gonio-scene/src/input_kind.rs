//! Detection of the kind of an input: by its content first, then by its name.

use gonio_image::decode::FileFormat;
use gonio_mesh::{Cause, Format, ReadError, compression, encoding, format};
use std::path::Path;

/// A kind of input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum InputKind {
    Scene,
    Model,
}

const READABLE: &str = "models (.obj .gltf .glb .dae .ply .stl .mesh .meshb, also .gz and .zst) and scene files (.toml) \
                        can be read";

/// Detects the kind of the file `name` with these bytes; the error is the reason why it cannot be read.
pub(crate) fn detect(bytes: &[u8], name: &Path) -> Result<InputKind, ReadError> {
    if bytes.is_empty() {
        return Err(ReadError::new(format!("the file is empty; {READABLE}")));
    }
    if compression::is_compressed(bytes) {
        return Ok(InputKind::Model);
    }
    if let Some(picture) = FileFormat::detect(bytes) {
        let message = format!(
            "this is {what}, not a model; to surround a model by it, name it as the environment",
            what = environment_kind(picture)
        );
        return Err(ReadError::new(message).caused_by(Cause::EnvironmentAsModel));
    }
    let extension = name.extension().and_then(|e| e.to_str()).unwrap_or("").to_ascii_lowercase();
    // A scene file is one by its name and content; a name alone makes only what is nothing else a scene.
    let is_toml = has_toml_line(bytes);
    if is_toml || extension == "toml" {
        match Format::detect(bytes, "") {
            Ok(Format::Obj) if is_toml && extension == "toml" => return Ok(InputKind::Scene),
            Err(None) if is_toml && extension != "obj" || extension == "toml" => return Ok(InputKind::Scene),
            _ => {}
        }
    }
    match Format::detect(bytes, &name.to_string_lossy()) {
        Ok(_) => Ok(InputKind::Model),
        Err(Some(other)) => Err(ReadError::new(format!("this is {other}; {READABLE}"))),
        Err(None) => Err(ReadError::new(unknown(bytes, &extension))),
    }
}

/// Whether a line near the start of a text is a table's header or a key with a value.
fn has_toml_line(bytes: &[u8]) -> bool {
    let text = encoding::start_as_utf8(bytes, 1 << 16);
    let start = format::start_behind_comments(&text);
    !start.contains('\0') && start.lines().any(is_toml_line)
}

/// `a model` or `a scene file`, if the content or the name of a file shows that it is one.
pub(crate) fn is_model_or_scene(bytes: &[u8], name: &Path) -> Option<&'static str> {
    if bytes.is_empty() || compression::is_compressed(bytes) {
        return None;
    }
    detect(bytes, name).ok().map(|kind| match kind {
        InputKind::Model => "a model",
        InputKind::Scene => "a scene file",
    })
}

fn environment_kind(format: FileFormat) -> &'static str {
    match format {
        FileFormat::Png => "a PNG image",
        FileFormat::Jpeg => "a JPEG image",
        FileFormat::Hdr => "a Radiance picture (.hdr)",
        FileFormat::Exr => "an OpenEXR picture",
        FileFormat::Ktx2 => "a KTX2 texture",
        FileFormat::Dds => "a DDS texture",
    }
}

/// The format of a model that is not compressed (any more).
pub(crate) fn format_of(bytes: &[u8], name: &str) -> Result<Format, String> {
    if bytes.is_empty() {
        return Err(format!("the file is empty; {READABLE}"));
    }
    Format::detect(bytes, name).map_err(|other| match other {
        Some(other) => format!("this is {other}; {READABLE}"),
        None => unknown(bytes, ""),
    })
}

fn unknown(bytes: &[u8], extension: &str) -> String {
    const LOOKED_AT: usize = 4096;
    let is_binary = bytes[..bytes.len().min(LOOKED_AT)].contains(&0) && !encoding::is_wide(bytes);
    let description = match (is_binary, extension) {
        (true, _) => "unknown binary format".to_owned(),
        (false, "") => "unknown file format".to_owned(),
        (false, extension) => format!("unknown format of this .{extension} file"),
    };
    format!("{description}; {READABLE}")
}

fn is_toml_line(line: &str) -> bool {
    let line = line.trim();
    let word = |s: &str| !s.is_empty() && s.chars().all(|c| c.is_ascii_alphanumeric() || "_-.".contains(c));
    if let Some(rest) = line.strip_prefix('[') {
        return word(rest.trim_start_matches('[').split(']').next().unwrap_or(""));
    }
    line.split_once('=').is_some_and(|(key, _)| word(key.trim()))
}
