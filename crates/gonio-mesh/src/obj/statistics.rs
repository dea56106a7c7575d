//! Counts of statements, faces and corners in a range of a file.

use super::attributes::Attributes;
use crate::diagnostic::Reports;
use crate::text::quote;
use crate::{Diagnostic, Severity};

/// Counts of statements, faces and corners in a range of a file.
#[derive(Default)]
pub(super) struct Statistics {
    /// Statements that were understood, except for faces.
    pub(super) statements: u64,
    /// Faces by number of corners, the last entry for all larger ones; without those left out.
    pub(super) faces: [u64; MOST_COUNTED + 2],
    /// Faces that were left out.
    pub(super) lost: u64,
    /// Corners of faces with more than three corners.
    pub(super) polygon_corners: u64,
    /// Corners without a texture coordinate or normal, and the first line with one.
    pub(super) without: [(u64, u64); 2],
    /// The first line with an index of a texture coordinate or normal, if the file has none.
    pub(super) without_any: [Option<u64>; 2],
    /// Polygons that cross or touch themselves, and those too large or complex to triangulate well.
    pub(super) cuts: [u64; 2],
    /// Numbers of `o`, `g`, `s`, `usemtl`, `mtllib`.
    pub(super) names: [u64; 5],
    pub(super) tallies: Tallies,
}

impl Statistics {
    /// Statements that were understood, except for attributes.
    pub(super) fn understood(&self) -> u64 {
        self.statements + self.face_count()
    }

    /// Faces, including those left out.
    pub(super) fn face_count(&self) -> u64 {
        self.faces.iter().sum::<u64>() + self.lost
    }

    /// Corners of faces that are drawn.
    pub(super) fn corners(&self) -> u64 {
        3 * self.faces[3] + self.polygon_corners
    }

    /// Adds the counts of the next range.
    pub(super) fn append(&mut self, other: Statistics) {
        fn add<const N: usize>(sums: &mut [u64; N], more: [u64; N]) {
            sums.iter_mut().zip(more).for_each(|(sum, more)| *sum += more);
        }
        self.statements += other.statements;
        self.lost += other.lost;
        self.polygon_corners += other.polygon_corners;
        add(&mut self.faces, other.faces);
        add(&mut self.cuts, other.cuts);
        add(&mut self.names, other.names);
        for (mine, theirs) in self.without.iter_mut().zip(other.without) {
            let first_line = if mine.0 == 0 { theirs.1 } else { mine.1 };
            *mine = (mine.0 + theirs.0, first_line);
        }
        for (mine, theirs) in self.without_any.iter_mut().zip(other.without_any) {
            *mine = mine.or(theirs);
        }
        self.tallies.append(other.tallies);
    }
}

/// Most corners for which faces are counted separately.
pub(super) const MOST_COUNTED: usize = 8;

/// The statements counted in [`Statistics::names`].
pub(super) const NAMES: [&str; 5] = ["o", "g", "s", "usemtl", "mtllib"];

/// Lists the non-zero counts under the format's own names.
pub(super) fn list(attributes: &Attributes, statistics: &Statistics) -> Vec<(String, u64)> {
    let mut contents: Vec<(String, u64)> = Vec::new();
    let mut add = |name: String, count: u64| {
        if count > 0 {
            contents.push((name, count));
        }
    };
    for (name, count) in ["v", "vt", "vn"].iter().zip(attributes.counts()) {
        add((*name).to_owned(), count);
    }
    add("v with a color".to_owned(), attributes.colored);
    for (corners, count) in statistics.faces.iter().enumerate() {
        let or_more = if corners > MOST_COUNTED { " or more" } else { "" };
        add(format!("f of {corners}{or_more} corners"), *count);
    }
    add("f left out".to_owned(), statistics.lost);
    for keyword in ["l", "p"] {
        add(keyword.to_owned(), statistics.tallies.count_of(keyword.as_bytes()));
    }
    for (name, count) in NAMES.iter().zip(statistics.names) {
        add((*name).to_owned(), count);
    }
    contents
}

/// Reports oddities of the file as a whole.
pub(super) fn report(attributes: &Attributes, statistics: &Statistics, reports: &mut Reports) {
    statistics.tallies.report(reports);
    if let Some(line) = attributes.weighted {
        reports.note(line, "the weights (w) of vertices are ignored: they only matter to free-form curves");
    }
    let total = attributes.positions.len() as u64;
    let lacking = total - attributes.colored;
    if attributes.colored > 0 && lacking > 0 {
        at_end(reports, format!("{lacking} of {total} vertices have no color: using white"));
    }
    for (line, what) in statistics.without_any.iter().zip(["texture coordinates (vt)", "normals (vn)"]) {
        if let Some(line) = *line {
            reports.warning(line, format!("faces refer to {what}, but the file has none"));
        }
    }
    let (total, consequences) =
        (statistics.corners(), ["texture coordinate: using (0, 0)", "normal: using averaged normals"]);
    for ((lacking, line), consequence) in statistics.without.into_iter().zip(consequences) {
        // If all corners lack it, the file simply has none.
        if lacking > 0 && lacking < total {
            reports.warning(line, format!("{lacking} of {total} corners of faces have no {consequence}"));
        }
    }
    let [not_simple, too_large] = statistics.cuts;
    if not_simple > 0 {
        at_end(reports, format!("{not_simple} polygons cross or touch themselves: their triangles are guessed"));
    }
    if too_large > 0 {
        at_end(reports, format!("{too_large} polygons are too large or complex: triangulated as if convex"));
    }
}

fn at_end(reports: &mut Reports, message: String) {
    reports.push(u64::MAX, Diagnostic::warning(message));
}

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
