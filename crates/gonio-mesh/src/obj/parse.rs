//! The first half of reading an OBJ: its statements, in order, as arrays.

use super::faces::Faces;
use crate::report::Reports;
use crate::text::{BadNumber, Cursor, quote};
use crate::{ReadError, Severity};
use glam::DVec3;

/// What the statements say. Indices of faces are resolved, yet may still point beyond the end.
#[derive(Default)]
pub(super) struct Statements {
    pub(super) positions: Vec<[f32; 3]>,
    /// Of as many positions as had a colour when the last one had one; white in between.
    pub(super) colors: Vec<[f32; 3]>,
    pub(super) tex_coords: Vec<[f32; 2]>,
    /// Unit vectors, or zero where the file's has no length.
    pub(super) normals: Vec<[f32; 3]>,
    pub(super) faces: Faces,
    /// Each `mtllib`, with its line.
    pub(super) libraries: Vec<(u64, String)>,
    pub(super) reports: Reports,
    /// How many statements were understood.
    pub(super) understood: u64,
    tallies: Vec<Tally>,
    colored: u64,
    weighted: Option<u64>,
}

/// A kind of statement that is not drawn.
struct Tally {
    keyword: Vec<u8>,
    count: u64,
    first_line: u64,
}

/// Kinds of unknown statements that are told one by one.
const MOST_UNKNOWN_KINDS: usize = 20;

/// Statements of the format that mean something to other programs, and nothing that could be drawn here.
const IGNORED: [&[u8]; 14] = [
    b"lod",
    b"bevel",
    b"c_interp",
    b"d_interp",
    b"mg",
    b"shadow_obj",
    b"trace_obj",
    b"maplib",
    b"usemap",
    b"ctech",
    b"stech",
    b"vw",
    b"csh",
    b"bsp",
];

/// Statements of free-form curves and surfaces.
const FREE_FORM: [&[u8]; 15] = [
    b"vp", b"cstype", b"deg", b"bmat", b"step", b"curv", b"curv2", b"surf", b"parm", b"trim", b"hole", b"scrv", b"sp",
    b"end", b"con",
];

impl Statements {
    /// Reads all statements.
    pub(super) fn parse(bytes: &[u8]) -> Result<Self, ReadError> {
        let mut statements = Statements::default();
        statements.reserve(bytes.len());
        let mut cursor = Cursor::new(bytes);
        while !cursor.at_end() {
            if cursor.next_word() {
                statements.statement(&mut cursor)?;
            }
            cursor.next_line();
        }
        statements.report_tallies();
        Ok(statements)
    }

    /// Room for what a file of this size usually holds (a triangle takes some 60 bytes with its share of the rest),
    /// so that the arrays are seldom moved.
    fn reserve(&mut self, size: usize) {
        self.positions.reserve(size / 160);
        self.faces.reserve(size / 80);
    }

    #[inline]
    fn statement(&mut self, cursor: &mut Cursor<'_>) -> Result<(), ReadError> {
        let keyword = cursor.word();
        match keyword {
            b"v" => self.vertex(cursor)?,
            b"vt" => self.tex_coord(cursor)?,
            b"vn" => self.normal(cursor)?,
            b"f" | b"fo" => self.face(cursor)?,
            b"o" | b"g" => self.faces.name_part(cursor.name()),
            b"usemtl" => {
                let line = cursor.line();
                self.faces.use_material(cursor.name(), line);
            }
            b"s" => self.smoothing_group(cursor),
            b"mtllib" => {
                let line = cursor.line();
                let name = cursor.name();
                if name.is_empty() {
                    self.reports.warning(line, "mtllib names no material library");
                } else {
                    self.libraries.push((line, name));
                }
            }
            _ => return self.other(keyword, cursor.line()),
        }
        self.understood += 1;
        Ok(())
    }

    fn vertex(&mut self, cursor: &mut Cursor<'_>) -> Result<(), ReadError> {
        let mut position = [0.0; 3];
        for value in &mut position {
            *value = coordinate(cursor, "v", 3)?;
        }
        if cursor.next_word() {
            self.more_of_vertex(cursor)?;
        }
        self.positions.push(position);
        Ok(())
    }

    /// After x y z: w, or r g b, or r g b a (whose a is ignored).
    fn more_of_vertex(&mut self, cursor: &mut Cursor<'_>) -> Result<(), ReadError> {
        let line = cursor.line();
        let mut more = [0.0; 4];
        let mut count = 0;
        while count < 4 && cursor.next_word() {
            more[count] = coordinate(cursor, "v", 3)?;
            count += 1;
        }
        match count {
            1 => {
                if more[0] != 1.0 && self.weighted.is_none() {
                    self.weighted = Some(line);
                }
            }
            3 | 4 => {
                self.colors.resize(self.positions.len(), [1.0; 3]);
                self.colors.push([more[0], more[1], more[2]]);
                self.colored += 1;
            }
            _ => self.reports.add("vertices with five numbers", Severity::Warning, line, None, || {
                "v has 5 numbers, which means nothing: the last two are ignored".to_owned()
            }),
        }
        Ok(())
    }

    fn tex_coord(&mut self, cursor: &mut Cursor<'_>) -> Result<(), ReadError> {
        let u = self.finite(cursor, "vt")?;
        let v = if cursor.next_word() { self.finite(cursor, "vt")? } else { 0.0 };
        self.tex_coords.push([u, v]);
        Ok(())
    }

    fn normal(&mut self, cursor: &mut Cursor<'_>) -> Result<(), ReadError> {
        let mut normal = [0.0; 3];
        for value in &mut normal {
            *value = self.finite(cursor, "vn")?;
        }
        let unit = DVec3::from(normal.map(f64::from)).normalize_or_zero();
        self.normals.push(unit.as_vec3().to_array());
        Ok(())
    }

    /// A number of a statement that a picture can do without: what is not finite becomes 0.
    #[inline]
    fn finite(&mut self, cursor: &mut Cursor<'_>, keyword: &'static str) -> Result<f32, ReadError> {
        if !cursor.next_word() {
            return Err(too_short(cursor, keyword, if keyword == "vt" { 1 } else { 3 }));
        }
        match cursor.number() {
            Ok(value) => Ok(value),
            Err(BadNumber::Unreadable) => Err(unreadable(cursor, keyword)),
            Err(BadNumber::NotFinite) => {
                let what = quote(cursor.offending_word());
                let (line, column) = (cursor.line(), Some(cursor.column()));
                let kind = if keyword == "vt" { "numbers of vt not finite" } else { "numbers of vn not finite" };
                self.reports.add(kind, Severity::Warning, line, column, || {
                    format!("{keyword} has {what}, which is not a finite number: 0 is taken instead")
                });
                while !cursor.at_word_end() || cursor.peek() == Some(b'#') && what.contains('#') {
                    cursor.advance();
                }
                Ok(0.0)
            }
        }
    }

    fn face(&mut self, cursor: &mut Cursor<'_>) -> Result<(), ReadError> {
        let counts = [self.positions.len(), self.tex_coords.len(), self.normals.len()];
        self.faces.read(cursor, counts, &mut self.reports)
    }

    fn smoothing_group(&mut self, cursor: &mut Cursor<'_>) {
        let has_word = cursor.next_word();
        let (line, column) = (cursor.line(), cursor.column());
        let word = if has_word { cursor.word() } else { b"" };
        let group = match word {
            b"off" => Some(0),
            b"on" => Some(1),
            _ => std::str::from_utf8(word).ok().and_then(|text| text.parse::<u32>().ok()),
        };
        if group.is_none() {
            let what = quote(word);
            self.reports.add("smoothing groups not understood", Severity::Warning, line, Some(column), || {
                format!("s is followed by {what} instead of a number or off: taken as off")
            });
        }
        self.faces.smooth(group.unwrap_or(0));
    }

    /// Whatever is not drawn is counted, to be told once.
    #[cold]
    fn other(&mut self, keyword: &[u8], line: u64) -> Result<(), ReadError> {
        let keyword = if FREE_FORM.contains(&keyword) { b"curv" } else { keyword };
        if keyword == b"l" || keyword == b"p" || keyword == b"curv" || IGNORED.contains(&keyword) {
            self.understood += 1;
        }
        if let Some(tally) = self.tallies.iter_mut().find(|tally| tally.keyword == keyword) {
            tally.count += 1;
        } else if self.tallies.len() < 3 * MOST_UNKNOWN_KINDS {
            // No more than that, or rubbish would fill the memory.
            let keyword = keyword[..keyword.len().min(200)].to_vec();
            self.tallies.push(Tally { keyword, count: 1, first_line: line });
        }
        Ok(())
    }

    fn report_tallies(&mut self) {
        let mut unknown_kinds = 0;
        for Tally { keyword, count, first_line } in std::mem::take(&mut self.tallies) {
            let times = |one: &str, many: &str| if count == 1 { format!("1 {one}") } else { format!("{count} {many}") };
            match keyword.as_slice() {
                b"l" => self.reports.warning(first_line, format!("{} not drawn (l)", times("line is", "lines are"))),
                b"p" => {
                    let message =
                        format!("{} not drawn (p)", times("statement of points is", "statements of points are"));
                    self.reports.warning(first_line, message);
                }
                b"curv" => {
                    let message = format!(
                        "free-form curves and surfaces are not drawn ({} of them)",
                        times("statement", "statements")
                    );
                    self.reports.warning(first_line, message);
                }
                ignored if IGNORED.contains(&ignored) => {
                    let name = String::from_utf8_lossy(ignored).into_owned();
                    self.reports.note(first_line, format!("{name} is ignored ({})", times("statement", "statements")));
                }
                unknown => {
                    unknown_kinds += 1;
                    if unknown_kinds <= MOST_UNKNOWN_KINDS {
                        let message = format!("{} is no known statement ({})", quote(unknown), times("time", "times"));
                        self.reports.warning(first_line, message);
                    }
                }
            }
        }
        if unknown_kinds > MOST_UNKNOWN_KINDS {
            let message =
                format!("and at least {} more kinds of unknown statements", unknown_kinds - MOST_UNKNOWN_KINDS);
            self.reports.push(u64::MAX, crate::Diagnostic::warning(message));
        }
        if let Some(line) = self.weighted {
            self.reports.note(line, "the weights (w) of vertices are ignored: they only matter to free-form curves");
        }
        let lacking = self.positions.len() as u64 - self.colored;
        if self.colored > 0 && lacking > 0 {
            let message = format!("{lacking} of {} vertices have no color: white is taken", self.positions.len());
            self.reports.push(u64::MAX, crate::Diagnostic::warning(message));
        }
    }
}

/// A number without which nothing can be drawn.
#[inline]
fn coordinate(cursor: &mut Cursor<'_>, keyword: &str, needed: usize) -> Result<f32, ReadError> {
    if !cursor.next_word() {
        return Err(too_short(cursor, keyword, needed));
    }
    match cursor.number() {
        Ok(value) => Ok(value),
        Err(BadNumber::Unreadable) => Err(unreadable(cursor, keyword)),
        Err(BadNumber::NotFinite) => Err(not_finite(cursor, keyword)),
    }
}

#[cold]
fn too_short(cursor: &Cursor<'_>, keyword: &str, needed: usize) -> ReadError {
    let numbers = if needed == 1 { "number" } else { "numbers" };
    ReadError::new(format!("{keyword} ends early: it needs at least {needed} {numbers}; is the file cut off?"))
        .at(cursor.line(), Some(cursor.column()))
}

#[cold]
fn unreadable(cursor: &Cursor<'_>, keyword: &str) -> ReadError {
    ReadError::new(format!("{keyword} has {} where a number should be", quote(cursor.offending_word())))
        .at(cursor.line(), Some(cursor.column()))
}

#[cold]
fn not_finite(cursor: &Cursor<'_>, keyword: &str) -> ReadError {
    let what = quote(cursor.offending_word());
    ReadError::new(format!("{keyword} has the coordinate {what}, which is not a finite number: export the model again"))
        .at(cursor.line(), Some(cursor.column()))
}
