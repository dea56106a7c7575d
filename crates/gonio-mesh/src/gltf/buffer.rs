//! Buffers and their views, and the binary container. A buffer is loaded when one of its bytes is first needed.

use super::json::JsonRef;
use super::uri::Uri;
use crate::diagnostic::Reports;
use crate::{Diagnostic, ReadError, SidecarUse, Sidecars};
use std::borrow::Cow;
use std::collections::HashMap;
use std::ops::Range;
use std::rc::Rc;

type Bytes<'v> = Rc<Cow<'v, [u8]>>;

/// The buffers of a file.
pub(super) struct Buffers<'v, 's> {
    root: JsonRef<'v>,
    /// The binary chunk of a `.glb`.
    binary: Option<&'v [u8]>,
    sidecars: &'s mut dyn Sidecars,
    fetched: HashMap<usize, Bytes<'v>>,
    /// Loaded files by their `uri`.
    files: HashMap<&'v str, Bytes<'v>>,
    /// The files requested from `sidecars`.
    pub uses: Vec<SidecarUse>,
}

/// A range of a buffer.
#[derive(Clone)]
pub(super) struct View<'v> {
    bytes: Bytes<'v>,
    range: Range<usize>,
    /// Bytes between the starts of two elements, if the file defines it.
    pub stride: Option<usize>,
}

impl View<'_> {
    pub fn bytes(&self) -> &[u8] {
        self.bytes.get(self.range.clone()).unwrap_or_default()
    }
}

impl<'v, 's> Buffers<'v, 's> {
    pub fn new(root: JsonRef<'v>, binary: Option<&'v [u8]>, sidecars: &'s mut dyn Sidecars) -> Self {
        Buffers { root, binary, sidecars, fetched: HashMap::new(), files: HashMap::new(), uses: Vec::new() }
    }

    /// Returns the view that the index `key` of `from` refers to.
    pub fn view(&mut self, from: JsonRef<'v>, key: &'v str) -> Result<Option<View<'v>>, ReadError> {
        let Some((_, at)) = from.target(self.root, key, "bufferViews")? else { return Ok(None) };
        let Some((index, buffer)) = at.target(self.root, "buffer", "buffers")? else {
            return Err(at.missing("buffer"));
        };
        let bytes = self.bytes(index, buffer)?;
        let first = at.unsigned("byteOffset")?.unwrap_or(0);
        let length = at.unsigned("byteLength")?.ok_or_else(|| at.missing("byteLength"))?;
        let range = range(first, length).filter(|range| range.end <= bytes.len());
        let range = range.ok_or_else(|| {
            let (path, size) = (at.path(), bytes.len());
            ReadError::new(format!("{path} is {length} bytes from byte {first}, but its buffer has {size}"))
        })?;
        let stride = at.index("byteStride")?.filter(|stride| *stride > 0);
        Ok(Some(View { bytes, range, stride }))
    }

    fn bytes(&mut self, index: usize, at: JsonRef<'v>) -> Result<Bytes<'v>, ReadError> {
        if let Some(bytes) = self.fetched.get(&index) {
            return Ok(bytes.clone());
        }
        let length = at.unsigned("byteLength")?.ok_or_else(|| at.missing("byteLength"))?;
        let bytes = match (at.text("uri")?, self.binary) {
            (Some(uri), _) => self.fetch(uri, at)?,
            (None, Some(binary)) if index == 0 => Rc::new(Cow::Borrowed(binary)),
            (None, _) => {
                let what = "has no uri, and there is no binary chunk for it: the file is damaged";
                return Err(ReadError::new(format!("{} {what}", at.path())));
            }
        };
        if (bytes.len() as u64) < length {
            let (path, there) = (at.path(), bytes.len());
            return Err(ReadError::new(format!(
                "{path} is cut off: it declares {length} bytes, but there are only {there}"
            )));
        }
        self.fetched.insert(index, bytes.clone());
        Ok(bytes)
    }

    fn fetch(&mut self, uri: &'v str, at: JsonRef<'v>) -> Result<Bytes<'v>, ReadError> {
        if let Some(bytes) = self.files.get(uri) {
            return Ok(bytes.clone());
        }
        let path = at.path();
        let bytes = match Uri::parse(uri) {
            Uri::Data(data) => data.map_err(|error| ReadError::new(format!("invalid data in {path}.uri: {error}")))?,
            Uri::Elsewhere => {
                let what = "is not fetched: put the file beside the model and its name into the uri";
                return Err(ReadError::new(format!("{} {what}", at.written("uri"))));
            }
            Uri::File(name) => {
                let (used, bytes) = SidecarUse::ask(self.sidecars, &name, None);
                let (tried, refused) = (used.tried.join(", "), used.refused.clone());
                self.uses.push(used);
                bytes.ok_or_else(|| {
                    if let Some(refused) = refused {
                        return ReadError::new(format!("{name:?}, which {path} names, was not read: {refused}"));
                    }
                    let tried_places = if tried.is_empty() { String::new() } else { format!("; tried {tried}") };
                    ReadError::new(format!(
                        "{name:?}, which {path} names, was not found: put it beside the model{tried_places}"
                    ))
                })?
            }
        };
        let bytes: Bytes<'v> = Rc::new(Cow::Owned(bytes));
        self.files.insert(uri, bytes.clone());
        Ok(bytes)
    }
}

/// Makes a range of an offset and a length, if it fits into memory.
pub(super) fn range(first: u64, length: u64) -> Option<Range<usize>> {
    let end = usize::try_from(first.checked_add(length)?).ok()?;
    Some(usize::try_from(first).ok()?..end)
}

const HEADER: usize = 12;
const JSON_CHUNK: [u8; 4] = *b"JSON";
const BINARY_CHUNK: [u8; 4] = *b"BIN\0";

/// The contents of a file.
pub(super) struct Container<'a> {
    pub json: &'a [u8],
    /// The contents of the buffer without a `uri`.
    pub binary: Option<&'a [u8]>,
    pub is_binary: bool,
}

/// Splits a `.glb` into its chunks; a `.gltf` is all JSON.
pub(super) fn open<'a>(bytes: &'a [u8], reports: &mut Reports) -> Result<Container<'a>, ReadError> {
    if bytes.starts_with(b"glTF") {
        return open_binary(bytes, reports);
    }
    let json = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    if json.trim_ascii().is_empty() {
        return Err(ReadError::new("the file is empty"));
    }
    if json.len() < bytes.len() {
        reports.push(0, Diagnostic::note("begins with a byte order mark, which JSON does not allow: skipped"));
    }
    Ok(Container { json, binary: None, is_binary: false })
}

fn open_binary<'a>(bytes: &'a [u8], reports: &mut Reports) -> Result<Container<'a>, ReadError> {
    let (Some(version), Some(length)) = (u32_at(bytes, 4), u32_at(bytes, 8)) else {
        let message = format!("is cut off after {} bytes, within its header of {HEADER}", bytes.len());
        return Err(ReadError::new(message));
    };
    match version {
        2 => {}
        1 => return Err(super::version_1()),
        _ => {
            return Err(ReadError::new(format!("byte 4: unknown container version {version}: expected 2")));
        }
    }
    let length = length as usize;
    if length > bytes.len() {
        let message = format!("is cut off: its header declares {length} bytes, but there are only {}", bytes.len());
        return Err(ReadError::new(message));
    }
    if length < bytes.len() {
        let message = format!("{} bytes after the end declared in the header are ignored", bytes.len() - length);
        reports.push(0, Diagnostic::warning(message));
    }
    let bytes = &bytes[..length];
    let mut container = Container { json: &[], binary: None, is_binary: true };
    let mut at = HEADER;
    let mut number = 0_usize;
    while at < length {
        let (kind, content) = chunk(bytes, at)?;
        match (number, kind) {
            (0, JSON_CHUNK) => container.json = content,
            (0, _) => return Err(ReadError::new(format!("byte {at}: the first chunk is not JSON"))),
            (_, BINARY_CHUNK) if container.binary.is_none() => container.binary = Some(content),
            _ => {
                let name = kind.escape_ascii();
                let message = || format!("byte {at}: a chunk of the unknown type \"{name}\" is skipped");
                reports.add_without_line("unknown chunks", crate::Severity::Note, message);
            }
        }
        number += 1;
        at += 8 + content.len();
    }
    if container.json.is_empty() {
        return Err(ReadError::new("contains no JSON: the file is cut off or empty"));
    }
    Ok(container)
}

/// Returns the type and content of the chunk at a byte.
fn chunk(bytes: &[u8], at: usize) -> Result<([u8; 4], &[u8]), ReadError> {
    let kind = bytes.get(at..).and_then(|rest| rest.get(4..8)?.try_into().ok());
    let (Some(length), Some(kind)) = (u32_at(bytes, at), kind) else {
        return Err(ReadError::new(format!("byte {at}: a chunk's header is cut off")));
    };
    let rest = &bytes[at + 8..];
    match rest.get(..length as usize) {
        Some(content) => Ok((kind, content)),
        None => {
            let there = rest.len();
            Err(ReadError::new(format!(
                "byte {at}: a chunk declares {length} bytes, but only {there} are left in the file"
            )))
        }
    }
}

fn u32_at(bytes: &[u8], at: usize) -> Option<u32> {
    bytes.get(at..)?.first_chunk().map(|word| u32::from_le_bytes(*word))
}
