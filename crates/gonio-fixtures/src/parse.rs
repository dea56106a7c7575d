//! The text of a table, line by line.

use super::FixtureFile;
use std::fmt;

/// The error of a table that cannot be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FixtureError {
    /// The table's path.
    pub table: String,
    /// The line in it, from 1, if the problem has one.
    pub line: Option<usize>,
    /// The fault.
    pub problem: FixtureProblem,
}

/// A fault of a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FixtureProblem {
    /// The file system's message.
    Unreadable(String),
    /// Bytes that are not UTF-8.
    NotUtf8,
    /// A carriage return in the table itself.
    CarriageReturn,
    /// The last line has no end.
    NoNewlineAtEnd,
    /// There is no header.
    NoFiles,
    /// A line that begins like a header but is malformed.
    MalformedHeader,
    /// A path that is absolute, leads out of the table, or is not portable.
    InvalidPath(String),
    /// The same path as an earlier file, whose line this is.
    DuplicatePath(usize),
    /// An unknown flag.
    UnknownFlag(String),
    /// Flags that contradict each other.
    FlagsExclude(&'static str, &'static str),
    /// `no-newline` on a file without lines.
    NoLineToEnd,
    /// A backslash that begins no escape.
    InvalidEscape,
    /// A character that is not part of a pair of hexadecimal digits.
    InvalidHex,
    /// A file outside the folders that form the cases.
    OutsideOfCases,
    /// The path of a file that is missing in a case.
    Missing(String),
    /// An expectation whose file is missing; the file's path.
    NothingExpectedOf(String),
}

impl std::error::Error for FixtureError {}

impl fmt::Display for FixtureError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line {
            Some(line) => write!(f, "{}:{line}: {}", self.table, self.problem),
            None => write!(f, "{}: {}", self.table, self.problem),
        }
    }
}

impl fmt::Display for FixtureProblem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            FixtureProblem::Unreadable(error) => write!(f, "cannot read the table: {error}"),
            FixtureProblem::NotUtf8 => f.write_str("not valid UTF-8: write the bytes as `\\xNN` in a file that is [escaped]"),
            FixtureProblem::CarriageReturn => {
                f.write_str("a carriage return: flag the file with [crlf], or write `\\r` in a file that is [escaped]")
            }
            FixtureProblem::NoNewlineAtEnd => f.write_str("the table must end with a line feed; [no-newline] describes a file without"),
            FixtureProblem::NoFiles => f.write_str("no file: a header is `-- PATH --`"),
            FixtureProblem::MalformedHeader => f.write_str(
                "malformed header: expected `-- PATH --` or `-- PATH [FLAGS] --`; a line of a file that begins with `-- ` is \
                 written as `\\x2d- ` in a file that is [escaped]",
            ),
            FixtureProblem::InvalidPath(path) => {
                write!(f, "invalid path `{path}`: expected a relative one, with `/` between its parts and without `..`")
            }
            FixtureProblem::DuplicatePath(line) => write!(f, "the file of line {line} has the same path"),
            FixtureProblem::UnknownFlag(flag) => {
                write!(f, "unknown flag `{flag}`: expected crlf, no-newline, escaped, utf-16le, utf-16be or hex")
            }
            FixtureProblem::FlagsExclude(a, b) => write!(f, "the flags {a} and {b} exclude each other"),
            FixtureProblem::NoLineToEnd => f.write_str("[no-newline] on a file without lines"),
            FixtureProblem::InvalidEscape => f.write_str("invalid escape: expected `\\\\`, `\\t`, `\\r`, `\\n`, `\\xNN` or `\\u{N}`"),
            FixtureProblem::InvalidHex => f.write_str("invalid byte: expected two hexadecimal digits"),
            FixtureProblem::OutsideOfCases => f.write_str("a file outside the folders of the cases"),
            FixtureProblem::Missing(path) => write!(f, "`{path}` is missing"),
            FixtureProblem::NothingExpectedOf(path) => write!(f, "the expectation of a missing file, `{path}`"),
        }
    }
}

/// A fault and its line; 0 if it has none.
type Result<T> = std::result::Result<T, (usize, FixtureProblem)>;

#[derive(Default)]
struct Flags {
    crlf: bool,
    no_newline: bool,
    escaped: bool,
    utf_16: Option<fn(u16) -> [u8; 2]>,
    hex: bool,
}

/// All files of a table, of which there must be at least one.
pub(crate) fn files(table: &[u8]) -> Result<Vec<FixtureFile>> {
    let text = str::from_utf8(table).map_err(|error| {
        let before = &table[..error.valid_up_to()];
        (1 + before.iter().filter(|byte| **byte == b'\n').count(), FixtureProblem::NotUtf8)
    })?;
    let lines: Vec<&str> = text.split_inclusive('\n').collect();
    if let Some(index) = lines.iter().position(|line| line.contains('\r')) {
        return Err((index + 1, FixtureProblem::CarriageReturn));
    }
    if lines.last().is_some_and(|line| !line.ends_with('\n')) {
        return Err((lines.len(), FixtureProblem::NoNewlineAtEnd));
    }
    let mut headers = Vec::new();
    for (index, line) in lines.iter().enumerate().filter(|(_, line)| line.starts_with("-- ")) {
        headers.push((index, header(line.trim_end_matches('\n')).map_err(|problem| (index + 1, problem))?));
    }
    if headers.is_empty() {
        return Err((0, FixtureProblem::NoFiles));
    }
    let ends: Vec<usize> = headers.iter().skip(1).map(|(index, _)| *index).chain([lines.len()]).collect();
    let mut files: Vec<FixtureFile> = Vec::new();
    for ((index, (path, flags)), end) in headers.into_iter().zip(ends) {
        let line = index + 1;
        if let Some(earlier) = files.iter().find(|file| file.path == path) {
            return Err((line, FixtureProblem::DuplicatePath(earlier.line)));
        }
        files.push(FixtureFile { path: path.to_owned(), bytes: content(&lines[line..end], &flags, line)?, line });
    }
    Ok(files)
}

fn header(line: &str) -> std::result::Result<(&str, Flags), FixtureProblem> {
    let inner =
        line.strip_prefix("-- ").and_then(|rest| rest.strip_suffix(" --")).ok_or(FixtureProblem::MalformedHeader)?;
    let (path, words) = match inner.strip_suffix(']') {
        Some(inner) => inner.rsplit_once(" [").ok_or(FixtureProblem::MalformedHeader)?,
        None => (inner, ""),
    };
    let is_portable = |part: &str| {
        !matches!(part, "" | "." | "..")
            && !part.contains(|c: char| c.is_control() || "\\:[]".contains(c))
            && part.trim() == part
    };
    if !path.split('/').all(is_portable) {
        return Err(FixtureProblem::InvalidPath(path.to_owned()));
    }
    let mut flags = Flags::default();
    for word in words.split(',').map(str::trim).filter(|_| inner.ends_with(']')) {
        match word {
            "crlf" => flags.crlf = true,
            "no-newline" => flags.no_newline = true,
            "escaped" => flags.escaped = true,
            "utf-16le" => flags.utf_16 = Some(u16::to_le_bytes),
            "utf-16be" => flags.utf_16 = Some(u16::to_be_bytes),
            "hex" => flags.hex = true,
            other => return Err(FixtureProblem::UnknownFlag(other.to_owned())),
        }
    }
    for (is_set, flag) in [
        (flags.crlf, "crlf"),
        (flags.no_newline, "no-newline"),
        (flags.escaped, "escaped"),
        (flags.utf_16.is_some(), "utf-16"),
    ] {
        if flags.hex && is_set {
            return Err(FixtureProblem::FlagsExclude("hex", flag));
        }
    }
    Ok((path, flags))
}

/// The bytes of a file from its lines, the first of which is the one after line `header`.
fn content(lines: &[&str], flags: &Flags, header: usize) -> Result<Vec<u8>> {
    if flags.no_newline && lines.is_empty() {
        return Err((header, FixtureProblem::NoLineToEnd));
    }
    let mut bytes = Vec::new();
    for (index, line) in lines.iter().enumerate() {
        let number = header + 1 + index;
        let text = line.trim_end_matches('\n');
        if flags.hex {
            hex(text, &mut bytes).ok_or((number, FixtureProblem::InvalidHex))?;
            continue;
        }
        if flags.escaped {
            unescape(text, &mut bytes).ok_or((number, FixtureProblem::InvalidEscape))?;
        } else {
            bytes.extend(text.as_bytes());
        }
        if !(flags.no_newline && index + 1 == lines.len()) {
            bytes.extend(if flags.crlf { &b"\r\n"[..] } else { b"\n" });
        }
    }
    match flags.utf_16 {
        Some(encode) => {
            let text = str::from_utf8(&bytes).map_err(|_| (header, FixtureProblem::NotUtf8))?;
            Ok(text.encode_utf16().flat_map(encode).collect())
        }
        None => Ok(bytes),
    }
}

fn hex(text: &str, bytes: &mut Vec<u8>) -> Option<()> {
    let digits: Vec<u8> = text.chars().filter(|c| *c != ' ').map(hex_digit).collect::<Option<_>>()?;
    let (pairs, rest) = digits.as_chunks::<2>();
    bytes.extend(pairs.iter().map(|[high, low]| 16 * high + low));
    rest.is_empty().then_some(())
}

fn hex_digit(c: char) -> Option<u8> {
    c.to_digit(16).and_then(|digit| u8::try_from(digit).ok())
}

fn unescape(text: &str, bytes: &mut Vec<u8>) -> Option<()> {
    let mut rest = text;
    while let Some((before, after)) = rest.split_once('\\') {
        bytes.extend(before.as_bytes());
        let mut chars = after.chars();
        match chars.next()? {
            '\\' => bytes.push(b'\\'),
            't' => bytes.push(b'\t'),
            'r' => bytes.push(b'\r'),
            'n' => bytes.push(b'\n'),
            'x' => bytes.push(16 * chars.next().and_then(hex_digit)? + chars.next().and_then(hex_digit)?),
            'u' => {
                let (digits, after) = chars.as_str().strip_prefix('{')?.split_once('}')?;
                let c = char::from_u32(u32::from_str_radix(digits, 16).ok()?)?;
                bytes.extend(c.encode_utf8(&mut [0; 4]).as_bytes());
                chars = after.chars();
            }
            _ => return None,
        }
        rest = chars.as_str();
    }
    bytes.extend(rest.as_bytes());
    Some(())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use crate::FixtureTable;

    fn only(text: &str) -> Vec<u8> {
        let table = FixtureTable::parse("table.txt", text.as_bytes()).unwrap();
        assert_eq!(table.files().len(), 1);
        table.files()[0].bytes.clone()
    }

    #[test]
    fn every_line_up_to_the_next_header_belongs_to_a_file() {
        let table = FixtureTable::parse("t", b"-- comment\n- so --\n\n-- with space.mtl --\na\n\n--b --\n-- d/e --\n");
        assert_eq!(table.unwrap_err().to_string().split(": ").next(), Some("t:1"));
        let table =
            FixtureTable::parse("t", b"- comment --\n\n-- with space.mtl --\na\n\n--b --\n-- d/e --\n").unwrap();
        let files: Vec<_> = table.files().iter().map(|f| (f.path.as_str(), f.bytes.as_slice(), f.line)).collect();
        assert_eq!(files, [("with space.mtl", &b"a\n\n--b --\n"[..], 3), ("d/e", b"", 7)]);
    }

    #[test]
    fn flags_describe_what_lines_of_text_cannot() {
        assert_eq!(only("-- a --\n\n"), b"\n");
        assert_eq!(only("-- a [crlf] --\na\n\nb\n"), b"a\r\n\r\nb\r\n");
        assert_eq!(only("-- a [crlf, no-newline] --\na\nb\n"), b"a\r\nb");
        assert_eq!(only("-- a [no-newline] --\n\n"), b"");
        assert_eq!(only("-- a [no-newline] --\na\n\n"), b"a\n");
        assert_eq!(
            only("-- a [escaped] --\n\\\\n\\t\\r\\n\\xFf\\u{e9}\\u{1f600}\\x20\n"),
            b"\\n\t\r\n\xFF\xC3\xA9\xF0\x9F\x98\x80 \n"
        );
        assert_eq!(only("-- a [escaped] --\n\\x2d- b --\n"), b"-- b --\n");
        assert_eq!(only("-- a --\n\\n\n"), b"\\n\n");
        assert_eq!(only("-- a [escaped, utf-16le] --\n\\u{feff}v\u{e9}\n"), b"\xFF\xFEv\0\xE9\0\n\0");
        assert_eq!(only("-- a [utf-16be, crlf] --\nv\n"), b"\0v\0\r\0\n");
        assert_eq!(only("-- a [hex] --\n00 ff\n7F80\n"), [0, 0xFF, 0x7F, 0x80]);
    }

    #[test]
    fn malformed_tables_are_refused_at_their_lines() {
        for (text, message) in [
            ("", "t: no file"),
            ("only a comment\n", "t: no file"),
            ("-- a --\nb", "t:2: the table must end with a line feed"),
            ("-- a --\n\nb\r\n", "t:3: a carriage return"),
            ("-- a --\n-- b -\n", "t:2: malformed header"),
            ("-- a --\n-- b\n", "t:2: malformed header"),
            ("-- --\n", "t:1: malformed header"),
            ("-- a] --\n", "t:1: malformed header"),
            ("-- ../a --\n", "t:1: invalid path `../a`"),
            ("-- /a --\n", "t:1: invalid path `/a`"),
            ("-- a//b --\n", "t:1: invalid path `a//b`"),
            ("-- c:\\a --\n", "t:1: invalid path `c:\\a`"),
            ("--  a --\n", "t:1: invalid path ` a`"),
            ("-- a[crlf --\n", "t:1: invalid path `a[crlf`"),
            ("-- a --\n-- b --\n-- a --\n", "t:3: the file of line 1 has the same path"),
            ("-- a [CRLF] --\n", "t:1: unknown flag `CRLF`"),
            ("-- a [] --\n", "t:1: unknown flag ``"),
            ("-- a [hex, crlf] --\n", "t:1: the flags hex and crlf exclude each other"),
            ("-- a --\n-- b [no-newline] --\n", "t:2: [no-newline] on a file without lines"),
            ("-- a [escaped] --\n\n\\q\n", "t:3: invalid escape"),
            ("-- a [escaped] --\n\\x4\n", "t:2: invalid escape"),
            ("-- a [escaped] --\n\\u{d800}\n", "t:2: invalid escape"),
            ("-- a [escaped] --\n\\\n", "t:2: invalid escape"),
            ("-- a [hex] --\n00\n0g\n", "t:3: invalid byte"),
            ("-- a [hex] --\n000\n", "t:2: invalid byte"),
            ("-- a [escaped, utf-16le] --\n\\xff\n", "t:1: not valid UTF-8"),
        ] {
            let error = FixtureTable::parse("t", text.as_bytes()).unwrap_err().to_string();
            assert!(error.starts_with(message), "{text:?}: {error}");
        }
        let error = FixtureTable::parse("t", b"-- a --\n\n\xE9\n").unwrap_err().to_string();
        assert!(error.starts_with("t:3: not valid UTF-8"), "{error}");
        let error = FixtureTable::read("missing/table.txt").unwrap_err().to_string();
        assert!(error.starts_with("missing/table.txt: cannot read the table"), "{error}");
    }
}
