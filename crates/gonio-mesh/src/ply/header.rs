//! The header of a PLY file: lines of text that describe the data.

use super::scalar::Scalar;
use crate::diagnostic::Reports;
use crate::text::{decode, quote};
use crate::{ReadError, Severity};

/// The encoding of the numbers after the header.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    Ascii,
    LittleEndian,
    BigEndian,
}

#[derive(Debug)]
pub(super) struct Header {
    pub(super) encoding: Encoding,
    pub(super) elements: Vec<Element>,
    /// Each `comment TextureFile`, as MeshLab writes it, with its line.
    pub(super) textures: Vec<(String, u64)>,
    pub(super) comments: u64,
    pub(super) obj_infos: u64,
    /// The byte where the numbers begin.
    pub(super) end: usize,
    /// The line where the numbers begin.
    pub(super) end_line: u64,
}

/// An element type and the number of such elements.
#[derive(Debug)]
pub(super) struct Element {
    pub(super) name: String,
    pub(super) count: u64,
    pub(super) properties: Vec<Property>,
}

/// A number, or a list of numbers, of each element.
#[derive(Debug)]
pub(super) struct Property {
    pub(super) name: String,
    /// The type of the number, or of those in the list.
    pub(super) value: Scalar,
    /// The type of a list's length.
    pub(super) count: Option<Scalar>,
}

impl Element {
    /// Returns the least size of an element in bytes.
    pub(super) fn least_size(&self, encoding: Encoding) -> usize {
        let of = |p: &Property| match encoding {
            // A digit and a separator.
            Encoding::Ascii => 2,
            _ => p.count.unwrap_or(p.value).size(),
        };
        self.properties.iter().map(of).sum()
    }
}

impl Header {
    /// Parses the header including `end_header`.
    pub(super) fn parse(bytes: &[u8], reports: &mut Reports) -> Result<Header, ReadError> {
        let mut lines = Lines::new(bytes);
        let first = lines.next().map(<[u8]>::trim_ascii);
        if first != Some(b"ply") {
            return Err(ReadError::new("this is not a PLY file: its first line is not `ply`"));
        }
        let mut encoding = None;
        let mut header = Header {
            encoding: Encoding::Ascii,
            elements: Vec::new(),
            textures: Vec::new(),
            comments: 0,
            obj_infos: 0,
            end: 0,
            end_line: 0,
        };
        while let Some(line) = lines.next() {
            let number = lines.number;
            let text = decode(line.trim_ascii());
            let mut words = text.split_ascii_whitespace();
            match words.next() {
                None => {}
                Some("format") => encoding = Some(format(&text, number, reports)?),
                Some("comment") => header.comment(&text, number),
                Some("obj_info") => header.obj_infos += 1,
                Some("element") => header.elements.push(element(&text, number)?),
                Some("property") => header.property(&text, number)?,
                Some("end_header") => {
                    let Some(encoding) = encoding else {
                        return Err(ReadError::new("the header has no format line, such as `format ascii 1.0`")
                            .at(number, None));
                    };
                    return Ok(Header { encoding, end: lines.at, end_line: number + 1, ..header });
                }
                Some(word) => reports.add("unknown lines of the header", Severity::Warning, number, None, || {
                    format!("unknown header line {}: it is skipped", quote(word.as_bytes()))
                }),
            }
        }
        let message = "the header has no `end_header` line: the file is cut off, get it again";
        Err(ReadError::new(message).at(lines.number, None))
    }

    fn comment(&mut self, text: &str, line: u64) {
        self.comments += 1;
        let rest = text["comment".len()..].trim_start();
        if let Some(name) = rest.strip_prefix("TextureFile").filter(|name| name.starts_with(char::is_whitespace)) {
            self.textures.push((name.trim().to_owned(), line));
        }
    }

    fn property(&mut self, text: &str, line: u64) -> Result<(), ReadError> {
        let words: Vec<&str> = text.split_ascii_whitespace().collect();
        let scalar = |name: &str| {
            Scalar::named(name).ok_or_else(|| {
                let message = format!("the property has the unknown type {}", quote(name.as_bytes()));
                ReadError::new(message + ": export the file again").at(line, None)
            })
        };
        let property = match words[..] {
            [_, "list", count, value, name] => {
                Property { name: name.to_owned(), value: scalar(value)?, count: Some(scalar(count)?) }
            }
            [_, value, name] if value != "list" => {
                Property { name: name.to_owned(), value: scalar(value)?, count: None }
            }
            _ => {
                let message = format!("invalid property {}: expected `property TYPE NAME` or ", quote(text.as_bytes()));
                return Err(ReadError::new(message + "`property list TYPE TYPE NAME`").at(line, None));
            }
        };
        let Some(element) = self.elements.last_mut() else {
            return Err(ReadError::new("a property precedes the first element").at(line, None));
        };
        element.properties.push(property);
        Ok(())
    }
}

fn format(text: &str, line: u64, reports: &mut Reports) -> Result<Encoding, ReadError> {
    let mut words = text.split_ascii_whitespace().skip(1);
    let encoding = match words.next() {
        Some("ascii") => Encoding::Ascii,
        Some("binary_little_endian") => Encoding::LittleEndian,
        Some("binary_big_endian") => Encoding::BigEndian,
        other => {
            let other = quote(other.unwrap_or_default().as_bytes());
            let message =
                format!("unknown PLY format {other}: expected ascii, binary_little_endian or binary_big_endian");
            return Err(ReadError::new(message).at(line, None));
        }
    };
    let version = words.next().unwrap_or_default();
    if version != "1.0" {
        let version = quote(version.as_bytes());
        reports.warning(line, format!("unknown format version {version}: reading it as 1.0"));
    }
    Ok(encoding)
}

fn element(text: &str, line: u64) -> Result<Element, ReadError> {
    let mut words = text.split_ascii_whitespace().skip(1);
    let name = words.next();
    let count = words.next().and_then(|count| count.parse().ok());
    let (Some(name), Some(count)) = (name, count) else {
        let message = format!("invalid element {}: expected `element NAME COUNT`", quote(text.as_bytes()));
        return Err(ReadError::new(message).at(line, None));
    };
    Ok(Element { name: name.to_owned(), count, properties: Vec::new() })
}

/// Lines that end with LF or CR LF, or with CR alone if the first one does. This must be known because the first byte
/// of a binary file's numbers may be an LF.
struct Lines<'a> {
    bytes: &'a [u8],
    at: usize,
    end: u8,
    /// The number of the latest line, from 1.
    number: u64,
}

impl<'a> Lines<'a> {
    fn new(bytes: &'a [u8]) -> Self {
        let first_end = bytes.iter().position(|byte| matches!(byte, b'\n' | b'\r'));
        let end = match first_end.map(|at| (bytes[at], bytes.get(at + 1))) {
            Some((b'\r', next)) if next != Some(&b'\n') => b'\r',
            _ => b'\n',
        };
        Lines { bytes, at: 0, end, number: 0 }
    }

    fn next(&mut self) -> Option<&'a [u8]> {
        let rest = self.bytes.get(self.at..).filter(|rest| !rest.is_empty())?;
        let length = rest.iter().position(|&byte| byte == self.end);
        self.at += length.map_or(rest.len(), |length| length + 1);
        self.number += 1;
        Some(&rest[..length.unwrap_or(rest.len())])
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    #[test]
    fn the_numbers_begin_behind_the_line_end_of_the_first_line() {
        for (end, text_end) in [("\n", ""), ("\r\n", ""), ("\r", ""), ("\n", "  \t")] {
            let header = format!("ply{end}format binary_big_endian 1.0{end}end_header{text_end}{end}");
            let bytes = [header.as_bytes(), b"\n\r\n"].concat();
            let parsed = Header::parse(&bytes, &mut Reports::default()).unwrap();
            assert_eq!((parsed.end, parsed.end_line), (header.len(), 4), "{header:?}");
        }
    }

    #[test]
    fn spacing_comments_and_types() {
        let text = "ply\n format\tascii  1.0 \ncomment TextureFile a b.png \ncomment made by hand\nobj_info num_cols 5\n\n\
                    element  vertex\t3\nproperty  float   x\nelement face 1\n  property list uint8 int32 vertex_indices\nend_header";
        let mut reports = Reports::default();
        let header = Header::parse(text.as_bytes(), &mut reports).unwrap();
        assert_eq!(reports.finish(), []);
        assert_eq!(header.textures, [("a b.png".to_owned(), 3)]);
        assert_eq!((header.comments, header.obj_infos, header.end), (2, 1, text.len()));
        let [vertex, face] = &header.elements[..] else { panic!("{header:?}") };
        assert_eq!((vertex.name.as_str(), vertex.count, vertex.properties[0].value), ("vertex", 3, Scalar::F32));
        let list = &face.properties[0];
        assert_eq!((list.count, list.value, list.name.as_str()), (Some(Scalar::U8), Scalar::I32, "vertex_indices"));
        assert_eq!((vertex.least_size(header.encoding), face.least_size(Encoding::BigEndian)), (2, 1));
    }
}
