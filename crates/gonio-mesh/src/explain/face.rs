//! Explains faces, lines and points: their corners, the values that indices refer to, and the triangles.

use super::file::{Extent, count, note, numbers, warning};
use super::walk::{self, Attribute, State};
use super::{LineExplanation, LineValue};
use crate::polygon::{Cut, Triangulator};
use crate::text::{Cursor, decode, quote};
use serde::Serialize;

/// Most corners that are checked: those for which ears are searched.
const MOST_CORNERS: usize = crate::polygon::MOST_CORNERS_FOR_EARS;
/// Most corners that are listed.
const MOST_TOLD: usize = 64;
/// Most triangles that are listed.
const MOST_TRIANGLES: usize = 20;
/// Most problems that are listed.
const MOST_PROBLEMS: usize = 20;

/// A corner of a face, line or list of points.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FaceCorner {
    /// The corner as written.
    pub written: String,
    /// Its line, from 1.
    pub line: u64,
    /// Its column in bytes, from 1.
    pub column: u64,
    /// The vertex that its first index refers to; `None` if there is none.
    pub vertex: Option<ReferencedAttribute>,
    /// The texture coordinate that its second index refers to.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tex_coord: Option<ReferencedAttribute>,
    /// The normal that its third index refers to.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub normal: Option<ReferencedAttribute>,
}

/// The value that an index refers to.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ReferencedAttribute {
    /// The index as written: from 1, or negative, counted back from the line.
    pub written: i64,
    /// The index counted from the start of the file, from 1.
    pub number: u64,
    /// The line of its `v`, `vt` or `vn` statement.
    pub line: u64,
    /// Its numbers; incomplete if some cannot be read.
    pub value: Vec<f32>,
}

/// A corner with its written indices and the column of each.
struct Corner {
    written: String,
    line: u64,
    columns: [u64; 3],
    indices: [Option<i64>; 3],
    /// Indices from 1; `None` for 0 and for negative indices that reach before the start of the file.
    numbers: [Option<u64>; 3],
}

/// A kind of element: its keyword and least number of corners.
#[derive(Clone, Copy)]
pub(super) struct Element {
    pub(super) keyword: &'static str,
    pub(super) least: u64,
}

/// Fills in the explanation of an `f`, `l` or `p`; the cursor is after its keyword.
pub(super) fn explain(
    element: Element,
    bytes: &[u8],
    cursor: &mut Cursor<'_>,
    state: &State,
    extent: Extent,
    explanation: &mut LineExplanation,
) {
    let (corners, corner_count) = read_corners(element, cursor, state, explanation);
    let mut requested: [Vec<u64>; 3] = Default::default();
    for corner in &corners {
        for (requested, number) in requested.iter_mut().zip(corner.numbers) {
            requested.extend(number);
        }
    }
    for requested in &mut requested {
        requested.sort_unstable();
        requested.dedup();
    }
    let (found, totals) = walk::attributes(bytes, &requested);
    let is_lost = report_missing(&corners, &found, totals, state, explanation);
    let targets: Vec<FaceCorner> = corners.iter().take(MOST_TOLD).map(|corner| target_of(corner, &found)).collect();
    let is_face = element.keyword == "f";
    if corner_count < element.least && explanation.problems.is_empty() {
        let what = count(corner_count, "corner", "corners");
        let message = match element.keyword {
            "f" => format!("f has {what}, too few for a triangle: it is left out"),
            _ => format!("{} has {what}, too few", element.keyword),
        };
        explanation.problems.push(crate::Diagnostic::warning(message).at(extent.first_line, None));
    }
    let mut triangles = Vec::new();
    if is_face && !is_lost && corner_count >= 3 && corner_count as usize == corners.len() {
        triangles = cut(&corners, &found[0], extent.first_line, explanation);
    }
    explanation.meaning = match element.keyword {
        "f" => meaning_of_face(state.faces + 1, corner_count, &triangles),
        "l" => format!("a line through {}, which is not drawn", count(corner_count, "vertex", "vertices")),
        _ => format!("{}, which are not drawn", count(corner_count, "point", "points")),
    };
    explanation.details.extend(targets.iter().enumerate().map(|(i, corner)| words_of_corner(i + 1, corner)));
    if corner_count > targets.len() as u64 {
        explanation.details.push(format!("and {} more corners", corner_count - targets.len() as u64));
    }
    if corner_count > corners.len() as u64 && explanation.problems.is_empty() {
        explanation.details.push(format!("only the first {} corners were checked", corners.len()));
    }
    let number = if is_face { state.faces + 1 } else { 0 };
    explanation.value = Some(LineValue::Element { number, corner_count, corners: targets, triangles });
}

/// Reads the first corners, and counts them all. Stops at one that cannot be read.
fn read_corners(
    element: Element,
    cursor: &mut Cursor<'_>,
    state: &State,
    explanation: &mut LineExplanation,
) -> (Vec<Corner>, u64) {
    let (mut corners, mut corner_count) = (Vec::new(), 0);
    while cursor.next_word() {
        let (line, column) = (cursor.line(), cursor.column());
        let word = cursor.offending_word();
        let Some(mut corner) = read_corner(cursor, state) else {
            // The cursor is at the error, as in the reader.
            let what = quote(cursor.offending_word());
            let keyword = element.keyword;
            let message = format!("{keyword}: expected an index (v, v/vt, v//vn or v/vt/vn), found {what}");
            explanation.problems.push(warning(message, cursor.line(), cursor.column()));
            break;
        };
        corner_count += 1;
        if corners.len() < MOST_CORNERS {
            corner.written = decode(&word[..word.len().min(80)]);
            (corner.line, corner.columns[0]) = (line, column);
            corners.push(corner);
        }
    }
    (corners, corner_count)
}

fn read_corner(cursor: &mut Cursor<'_>, state: &State) -> Option<Corner> {
    let mut corner =
        Corner { written: String::new(), line: 0, columns: [0; 3], indices: [None; 3], numbers: [None; 3] };
    for kind in 0..3 {
        corner.columns[kind] = cursor.column();
        match cursor.integer() {
            Some(index) => {
                corner.indices[kind] = Some(index);
                let number = if index < 0 {
                    state.counts[kind].checked_add_signed(index).map(|n| n + 1)
                } else {
                    Some(index as u64)
                };
                corner.numbers[kind] = number.filter(|number| *number > 0);
            }
            None if kind > 0 && (cursor.at_word_end() || cursor.peek() == Some(b'/')) => {}
            None => return None,
        }
        if kind == 2 || cursor.peek() != Some(b'/') {
            break;
        }
        cursor.advance();
    }
    cursor.at_word_end().then_some(corner)
}

fn find(found: &[Attribute], number: u64) -> Option<&Attribute> {
    found.binary_search_by_key(&number, |attribute| attribute.number).ok().and_then(|at| found.get(at))
}

fn target_of(corner: &Corner, found: &[Vec<Attribute>; 3]) -> FaceCorner {
    let target = |kind: usize| {
        let attribute = find(&found[kind], corner.numbers[kind]?)?;
        let (written, number, line) = (corner.indices[kind]?, attribute.number, attribute.line);
        Some(ReferencedAttribute { written, number, line, value: attribute.values.clone() })
    };
    FaceCorner {
        written: corner.written.clone(),
        line: corner.line,
        column: corner.columns[0],
        vertex: target(0),
        tex_coord: target(1),
        normal: target(2),
    }
}

/// Reports indices out of range. Returns whether the element cannot be drawn because of them.
fn report_missing(
    corners: &[Corner],
    found: &[Vec<Attribute>; 3],
    totals: [u64; 3],
    state: &State,
    explanation: &mut LineExplanation,
) -> bool {
    const WORDS: [(&str, &str, &str, &str); 3] = [
        ("v", "vertex", "vertices", "the face is left out"),
        ("vt", "texture coordinate", "texture coordinates", "using (0, 0)"),
        ("vn", "normal", "normals", "using an averaged normal"),
    ];
    let mut is_lost = false;
    for corner in corners {
        for (kind, (keyword, one, many, consequence)) in WORDS.into_iter().enumerate() {
            let Some(index) = corner.indices[kind] else { continue };
            if corner.numbers[kind].is_some_and(|number| find(&found[kind], number).is_some()) {
                continue;
            }
            is_lost |= kind == 0;
            let (total, before) = (totals[kind].max(state.counts[kind]), state.counts[kind]);
            let exist = |n: u64| if n == 1 { format!("is 1 {one}") } else { format!("are {n} {many}") };
            let problem = match index {
                0 => "but indices are counted from 1".to_owned(),
                _ if index < 0 => format!("but there {} before it", exist(before)),
                _ => format!("but there {}", exist(total)),
            };
            if explanation.problems.len() < MOST_PROBLEMS {
                let message = format!("f has the {keyword} index {index}, {problem}: {consequence}");
                explanation.problems.push(warning(message, corner.line, corner.columns[kind]));
            }
        }
    }
    is_lost
}

/// Returns the triangles, as corners counted from 1.
fn cut(corners: &[Corner], vertices: &[Attribute], line: u64, explanation: &mut LineExplanation) -> Vec<[usize; 3]> {
    let mut kept: Vec<usize> = Vec::new();
    let mut points: Vec<[f32; 3]> = Vec::new();
    let mut previous = corners.last().and_then(|corner| corner.numbers[0]);
    for (i, corner) in corners.iter().enumerate() {
        let is_again = corners.len() > 3 && corner.numbers[0] == previous;
        previous = corner.numbers[0];
        let position = previous.and_then(|number| find(vertices, number)).map(|v| v.values.as_slice());
        match position {
            Some(&[x, y, z]) if !is_again => {
                kept.push(i + 1);
                points.push([x, y, z]);
            }
            Some(&[_, _, _]) => {
                let message = "a corner repeats the one before it: it counts once";
                explanation.problems.push(note(message, corner.line, corner.columns[0]));
            }
            _ => {
                let message = "the numbers of one of its vertices cannot be read: no triangle can be made";
                explanation.problems.push(crate::Diagnostic::warning(message).at(line, None));
                return Vec::new();
            }
        }
    }
    let mut triangles = Vec::new();
    let how = Triangulator::default().triangulate(&points, |triangle| triangles.push(triangle.map(|i| kept[i])));
    if how == Cut::NotSimple {
        let message = "the polygon crosses or touches itself: its triangles are guessed";
        explanation.problems.push(crate::Diagnostic::warning(message).at(line, None));
    }
    explanation.problems.truncate(MOST_PROBLEMS);
    triangles
}

fn meaning_of_face(number: u64, corners: u64, triangles: &[[usize; 3]]) -> String {
    let what = match (corners, triangles) {
        (3, [_]) => return format!("face {number} of this file, a triangle"),
        (_, []) => return format!("face {number} of this file, with {}", count(corners, "corner", "corners")),
        (_, [_]) => "makes one triangle",
        _ => "is cut into",
    };
    let list: Vec<String> = triangles.iter().take(MOST_TRIANGLES).map(|[a, b, c]| format!("({a} {b} {c})")).collect();
    let more = if triangles.len() > MOST_TRIANGLES { " and so on" } else { "" };
    let into = if triangles.len() == 1 { String::new() } else { format!(" {} triangles", triangles.len()) };
    format!("face {number} of this file, with {corners} corners, {what}{into}: {}{more}", list.join(", "))
}

/// For example: `corner 2 is `-3/-1`: vertex 6 (line 9): 0.5 0 1; texture coordinate 4 (line 15): 0 1`
fn words_of_corner(number: usize, corner: &FaceCorner) -> String {
    let words = |what: &str, target: &ReferencedAttribute| {
        format!("{what} {} (line {}): {}", target.number, target.line, numbers(&target.value))
    };
    let vertex = corner.vertex.as_ref().map_or("no vertex".to_owned(), |target| words("vertex", target));
    let mut text = format!("corner {number} is {}: {vertex}", super::file::named(&corner.written));
    for (what, target) in [("texture coordinate", &corner.tex_coord), ("normal", &corner.normal)] {
        if let Some(target) = target {
            text.push_str("; ");
            text.push_str(&words(what, target));
        }
    }
    text
}
