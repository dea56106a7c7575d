//! Numbers and colours in statements of a material, with their positions.

use crate::diagnostic::Reports;
use crate::text::{BadNumber, Cursor, quote};
use crate::{PropertySource, Severity};

/// The longest text of a statement that is kept, in characters.
const LONGEST: usize = 80;

/// The position and text of a statement.
#[derive(Clone, Default)]
pub(super) struct Place {
    pub(super) line: u64,
    pub(super) column: u64,
    /// The text as in the file, without the comment and with single blanks for joined lines; shortened.
    pub(super) written: String,
}

impl Place {
    /// Captures the statement whose keyword was just read.
    pub(super) fn of_statement(line: u64, column: u64, keyword: &[u8], cursor: &Cursor<'_>) -> Self {
        let rest = cursor.rest();
        // Take more than is kept, but do not copy a name of some gigabytes.
        let rest = Cursor::new(&rest[..rest.len().min(8 * LONGEST)]).name();
        let keyword = String::from_utf8_lossy(&keyword[..keyword.len().min(4 * LONGEST)]);
        let whole = if rest.is_empty() { keyword.into_owned() } else { format!("{keyword} {rest}") };
        let mut written: String = whole.chars().take(LONGEST).collect();
        if whole.chars().nth(LONGEST).is_some() {
            written.push_str("...");
        }
        Place { line, column, written }
    }
}

/// A value, and the statement that sets it.
#[derive(Clone)]
pub(super) struct Located<T> {
    pub(super) value: T,
    pub(super) place: Place,
}

impl<T> Located<T> {
    /// Creates the source of a property of a material.
    pub(super) fn source(&self, property: &'static str, rule: impl Into<String>) -> PropertySource {
        PropertySource { property, line: Some(self.place.line), written: self.place.written.clone(), rule: rule.into() }
    }
}

/// Creates the source of a property that a statement may set, or a rule.
pub(super) fn source<T>(
    property: &'static str,
    located: Option<&Located<T>>,
    rule: impl Into<String>,
) -> PropertySource {
    match located {
        Some(located) => located.source(property, rule),
        None => PropertySource { property, line: None, written: String::new(), rule: rule.into() },
    }
}

/// Stores the value of a statement, if it has one. Of two statements the last is used, which is noted.
pub(super) fn put<T>(
    slot: &mut Option<Located<T>>,
    value: Option<T>,
    place: &Place,
    keyword: &'static str,
    reports: &mut Reports,
) {
    let Some(value) = value else { return };
    if let Some(earlier) = slot {
        let line = earlier.place.line;
        reports.add("repeated statements", Severity::Note, place.line, Some(place.column), || {
            format!("{keyword} is already set on line {line}: using this one")
        });
    }
    *slot = Some(Located { value, place: place.clone() });
}

/// Reads `r g b`, one number for grey, or `xyz x y z`, as linear RGB. Spectra are not read.
pub(super) fn color(cursor: &mut Cursor<'_>, keyword: &'static str, reports: &mut Reports) -> Option<[f32; 3]> {
    let (line, has_word) = (cursor.line(), cursor.next_word());
    let column = Some(cursor.column());
    if has_word && cursor.offending_word().eq_ignore_ascii_case(b"spectral") {
        cursor.word();
        let file = cursor.name();
        reports.add("colors given by spectra", Severity::Warning, line, column, || {
            format!("{keyword} names the spectrum {}, which is not read: it is ignored", quote(file.as_bytes()))
        });
        return None;
    }
    if has_word && cursor.offending_word().eq_ignore_ascii_case(b"xyz") {
        cursor.word();
        let rgb = linear_rgb_from_xyz(three(cursor, keyword, reports)?);
        if rgb.iter().any(|c| *c < 0.0) {
            reports.add("colors beyond sRGB", Severity::Note, line, column, || {
                format!("{keyword} xyz is outside the sRGB gamut: negative components become 0")
            });
        }
        return Some(rgb.map(|c| c.max(0.0)));
    }
    three(cursor, keyword, reports)
}

/// IEC 61966-2-1: 1999 with amendment 1, the matrix for a white of D65 with Y = 1.
fn linear_rgb_from_xyz([x, y, z]: [f32; 3]) -> [f32; 3] {
    const ROWS: [[f64; 3]; 3] = [
        [3.240_625_5, -1.537_208, -0.498_628_6],
        [-0.968_930_7, 1.875_756_1, 0.041_517_5],
        [0.055_710_1, -0.204_021_1, 1.056_995_9],
    ];
    let [x, y, z] = [x, y, z].map(f64::from);
    ROWS.map(|[a, b, c]| (a * x + b * y + c * z) as f32)
}

/// Reads three numbers, or one for all three.
fn three(cursor: &mut Cursor<'_>, keyword: &'static str, reports: &mut Reports) -> Option<[f32; 3]> {
    let first = scalar(cursor, keyword, reports)?;
    if !cursor.next_word() {
        return Some([first; 3]);
    }
    let second = scalar(cursor, keyword, reports)?;
    if !cursor.next_word() {
        let (line, column) = (cursor.line(), Some(cursor.column()));
        reports.add("colors with two numbers", Severity::Warning, line, column, || {
            format!("{keyword} has 2 numbers instead of 1 or 3: it is ignored")
        });
        return None;
    }
    let color = [first, second, scalar(cursor, keyword, reports)?];
    nothing_left(cursor, keyword, reports);
    Some(color)
}

/// Reads one number, finite and not negative, with nothing after it.
pub(super) fn only_scalar(cursor: &mut Cursor<'_>, keyword: &'static str, reports: &mut Reports) -> Option<f32> {
    let value = scalar(cursor, keyword, reports)?;
    nothing_left(cursor, keyword, reports);
    Some(value)
}

fn nothing_left(cursor: &mut Cursor<'_>, keyword: &'static str, reports: &mut Reports) {
    if cursor.next_word() {
        let (line, column, what) = (cursor.line(), Some(cursor.column()), quote(cursor.offending_word()));
        reports.add("words after the numbers of materials", Severity::Warning, line, column, || {
            format!("{keyword} has {what} after its last number, which is ignored")
        });
    }
}

/// Reads a number that is finite and not negative.
fn scalar(cursor: &mut Cursor<'_>, keyword: &'static str, reports: &mut Reports) -> Option<f32> {
    let has_word = cursor.next_word();
    let (line, column) = (cursor.line(), Some(cursor.column()));
    let what = quote(cursor.offending_word());
    let problem = match cursor.number() {
        _ if !has_word => "ends before its number".to_owned(),
        Ok(value) if value >= 0.0 => return Some(value.abs()),
        Ok(_) => format!("is negative ({what})"),
        Err(BadNumber::NotFinite) => format!("has {what}, which is not finite"),
        Err(BadNumber::Unreadable) => format!("has {what} instead of a number"),
    };
    reports.add("invalid numbers of materials", Severity::Warning, line, column, || {
        format!("{keyword} {problem}: it is ignored")
    });
    None
}
