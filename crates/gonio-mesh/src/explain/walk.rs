//! Walks over the statements of an OBJ file up to the requested line, collecting counts and the settings in force.

use super::InForce;
use super::file::{Extent, no_such_line, printable};
use crate::ReadError;
use crate::text::Cursor;

/// Most material libraries whose names are kept.
const MOST_LIBRARIES: usize = 10;

/// A name, and the line that sets it.
pub(super) type Named = (String, u64);

/// The counts and settings of the statements so far.
#[derive(Default)]
pub(super) struct State {
    /// Numbers of `v`, `vt` and `vn`.
    pub(super) counts: [u64; 3],
    pub(super) faces: u64,
    pub(super) object: Option<Named>,
    pub(super) group: Option<Named>,
    pub(super) material: Option<Named>,
    pub(super) smoothing: Option<Named>,
    /// The first libraries.
    pub(super) libraries: Vec<Named>,
}

impl State {
    pub(super) fn in_force(&self) -> Vec<InForce> {
        let single = [
            ("object", &self.object),
            ("group", &self.group),
            ("material", &self.material),
            ("smoothing group", &self.smoothing),
        ];
        let entry = |what, (name, line): &Named| InForce { what, name: printable(name), line: *line };
        let libraries = self.libraries.iter().map(|named| entry("material library", named));
        single.iter().filter_map(|(what, named)| Some(entry(what, named.as_ref()?))).chain(libraries).collect()
    }

    fn apply(&mut self, keyword: Keyword, named: Named) {
        match keyword {
            Keyword::Attribute(kind) => self.counts[kind] += 1,
            Keyword::Face => self.faces += 1,
            Keyword::Object => self.object = Some(named),
            Keyword::Group => self.group = Some(named),
            // An empty name means no material.
            Keyword::Material => self.material = Some(named).filter(|(name, _)| !name.is_empty()),
            Keyword::Smoothing => self.smoothing = Some(named),
            Keyword::Library if self.libraries.len() < MOST_LIBRARIES => self.libraries.push(named),
            Keyword::Library | Keyword::Other => {}
        }
    }
}

/// Keywords of statements that affect others.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Keyword {
    /// The index: 0 for `v`, 1 for `vt`, 2 for `vn`.
    Attribute(usize),
    Face,
    Object,
    Group,
    Material,
    Smoothing,
    Library,
    Other,
}

impl Keyword {
    fn from_word(word: &[u8]) -> Self {
        match word {
            b"v" => Keyword::Attribute(0),
            b"vt" => Keyword::Attribute(1),
            b"vn" => Keyword::Attribute(2),
            b"f" | b"fo" => Keyword::Face,
            b"o" => Keyword::Object,
            b"g" => Keyword::Group,
            b"usemtl" => Keyword::Material,
            b"s" => Keyword::Smoothing,
            b"mtllib" => Keyword::Library,
            _ => Keyword::Other,
        }
    }

    fn has_name(self) -> bool {
        matches!(self, Keyword::Object | Keyword::Group | Keyword::Material | Keyword::Smoothing | Keyword::Library)
    }
}

/// Finds the statement that contains a line, and the settings before it.
pub(super) fn find(bytes: &[u8], line: u64) -> Result<(Extent, State), ReadError> {
    let mut state = State::default();
    let mut cursor = Cursor::new(bytes);
    while !cursor.at_end() && line > 0 {
        let (start, first_line) = (cursor.position(), cursor.line());
        let keyword = if cursor.next_word() { Keyword::from_word(cursor.word()) } else { Keyword::Other };
        let named = if keyword.has_name() { (cursor.name(), first_line) } else { (String::new(), 0) };
        cursor.next_line();
        let extent = Extent::ending_at(start, first_line, &cursor, bytes);
        if extent.last_line >= line {
            return Ok((extent, state));
        }
        state.apply(keyword, named);
    }
    Err(no_such_line(line, &cursor, bytes))
}

/// Counts the faces between a statement and the next one of the kinds `until`, and returns the line of the latter;
/// `None` at the end of the file.
pub(super) fn faces_after(bytes: &[u8], extent: Extent, until: &[Keyword]) -> (u64, Option<u64>) {
    let mut cursor = Cursor::at_line(bytes, extent.start, extent.first_line);
    if cursor.next_word() {
        cursor.word();
        cursor.name();
    }
    cursor.next_line();
    let mut faces = 0;
    while !cursor.at_end() {
        let line = cursor.line();
        if cursor.next_word() {
            let keyword = Keyword::from_word(cursor.word());
            if until.contains(&keyword) {
                return (faces, Some(line));
            }
            faces += u64::from(keyword == Keyword::Face);
            if keyword.has_name() {
                cursor.name();
            }
        }
        cursor.next_line();
    }
    (faces, None)
}

/// The position of a `v`, `vt` or `vn` and its numbers; incomplete if some cannot be read.
#[derive(Clone, Debug)]
pub(super) struct Attribute {
    pub(super) number: u64,
    pub(super) line: u64,
    pub(super) values: Vec<f32>,
}

/// Finds attributes by their numbers (from 1, ascending, for each kind). Also returns the total count of each kind if
/// some were not found.
pub(super) fn attributes(bytes: &[u8], requested: &[Vec<u64>; 3]) -> ([Vec<Attribute>; 3], [u64; 3]) {
    let mut found: [Vec<Attribute>; 3] = Default::default();
    let mut counts = [0; 3];
    let mut cursor = Cursor::new(bytes);
    let mut missing: usize = requested.iter().map(Vec::len).sum();
    while !cursor.at_end() && missing > 0 {
        if cursor.next_word() {
            let line = cursor.line();
            let keyword = Keyword::from_word(cursor.word());
            if let Keyword::Attribute(kind) = keyword {
                counts[kind] += 1;
                if requested[kind].get(found[kind].len()) == Some(&counts[kind]) {
                    let values = values(&mut cursor, if kind == 1 { 2 } else { 3 });
                    found[kind].push(Attribute { number: counts[kind], line, values });
                    missing -= 1;
                }
            } else if keyword.has_name() {
                cursor.name();
            }
        }
        cursor.next_line();
    }
    (found, counts)
}

fn values(cursor: &mut Cursor<'_>, most: usize) -> Vec<f32> {
    let mut values = Vec::new();
    while values.len() < most && cursor.next_word() {
        let Ok(value) = cursor.number() else { break };
        values.push(value);
    }
    values
}
