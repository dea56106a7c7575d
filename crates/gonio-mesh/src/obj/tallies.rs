//! Counts statements that are not drawn, and reports each kind once.

use crate::report::Reports;
use crate::text::quote;
use crate::{Diagnostic, Severity};

/// Statements of a range of a file that are not drawn.
#[derive(Default)]
pub(super) struct Tallies {
    tallies: Vec<Tally>,
    /// Whether there were more kinds than are counted.
    pub(super) is_full: bool,
}

struct Tally {
    keyword: Vec<u8>,
    count: u64,
    first_line: u64,
}

/// Most kinds of unknown statements that are listed.
const MOST_UNKNOWN_KINDS: usize = 20;

/// Most kinds that are counted, so that garbage cannot fill the memory.
const MOST_KINDS: usize = 3 * MOST_UNKNOWN_KINDS;

/// Statements of the format without an effect on the mesh.
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

impl Tallies {
    /// Counts a statement. Returns whether it belongs to the format.
    pub(super) fn count(&mut self, keyword: &[u8], line: u64) -> bool {
        let keyword = if FREE_FORM.contains(&keyword) { b"curv" } else { keyword };
        self.add(&keyword[..keyword.len().min(200)], 1, line);
        keyword == b"l" || keyword == b"p" || keyword == b"curv" || IGNORED.contains(&keyword)
    }

    fn add(&mut self, keyword: &[u8], count: u64, line: u64) {
        if let Some(tally) = self.tallies.iter_mut().find(|tally| tally.keyword == keyword) {
            tally.count += count;
        } else if self.tallies.len() < MOST_KINDS {
            self.tallies.push(Tally { keyword: keyword.to_vec(), count, first_line: line });
        } else {
            self.is_full = true;
        }
    }

    /// Adds the counts of the next range.
    pub(super) fn append(&mut self, other: Tallies) {
        for tally in other.tallies {
            self.add(&tally.keyword, tally.count, tally.first_line);
        }
        self.is_full |= other.is_full;
    }

    /// Returns the count of one kind.
    pub(super) fn count_of(&self, keyword: &[u8]) -> u64 {
        self.tallies.iter().find(|tally| tally.keyword == keyword).map_or(0, |tally| tally.count)
    }

    pub(super) fn report(&self, reports: &mut Reports) {
        let mut unknown_kinds = 0;
        for &Tally { ref keyword, count, first_line } in &self.tallies {
            let (severity, message) = match describe(keyword, count) {
                Some(described) => described,
                None => {
                    unknown_kinds += 1;
                    if unknown_kinds > MOST_UNKNOWN_KINDS {
                        continue;
                    }
                    let times = if count == 1 { "1 time".to_owned() } else { format!("{count} times") };
                    (Severity::Warning, format!("unknown statement {} ({times})", quote(keyword)))
                }
            };
            let diagnostic = Diagnostic { severity, ..Diagnostic::warning(message) };
            reports.push(first_line, diagnostic.at(first_line, None));
        }
        if unknown_kinds > MOST_UNKNOWN_KINDS {
            let message =
                format!("and at least {} more kinds of unknown statements", unknown_kinds - MOST_UNKNOWN_KINDS);
            reports.push(u64::MAX, Diagnostic::warning(message));
        }
    }
}

/// Describes a statement of the format.
fn describe(keyword: &[u8], count: u64) -> Option<(Severity, String)> {
    let times = |one: &str, many: &str| if count == 1 { format!("1 {one}") } else { format!("{count} {many}") };
    Some(match keyword {
        b"l" => (Severity::Warning, format!("{} not drawn (l)", times("line is", "lines are"))),
        b"p" => {
            let statements = times("statement of points is", "statements of points are");
            (Severity::Warning, format!("{statements} not drawn (p)"))
        }
        b"curv" => {
            let statements = times("statement", "statements");
            (Severity::Warning, format!("free-form curves and surfaces are not drawn ({statements} of them)"))
        }
        ignored if IGNORED.contains(&ignored) => {
            let name = String::from_utf8_lossy(ignored);
            (Severity::Note, format!("{name} is ignored ({})", times("statement", "statements")))
        }
        _ => return None,
    })
}
