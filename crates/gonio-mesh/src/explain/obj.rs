//! Explains statements of an OBJ file.

use super::face::{self, Element};
use super::file::{Extent, blank, count, describe_extent, named, note, numbers, warning};
use super::walk::{self, Keyword, State};
use super::{LineExplanation, LineValue};
use crate::obj::{SmoothingGroup, not_finite_behind_position};
use crate::text::{BadNumber, Cursor, quote};
use crate::{Diagnostic, ReadError};
use glam::DVec3;

/// Statements that are known but not used, and their meanings.
const OTHERS: [(&str, &str); 29] = [
    ("vp", "a point in the parameter space of a free-form curve or surface: skipped"),
    ("cstype", "the type of free-form curves and surfaces: skipped"),
    ("deg", "the degree of free-form curves and surfaces: skipped"),
    ("bmat", "the basis matrix of free-form curves and surfaces: skipped"),
    ("step", "the step size of free-form curves and surfaces: skipped"),
    ("curv", "a free-form curve: skipped"),
    ("curv2", "a free-form curve on a surface: skipped"),
    ("surf", "a free-form surface: skipped"),
    ("parm", "parameter values of a free-form curve or surface: skipped"),
    ("trim", "an outer trimming loop of a free-form surface: skipped"),
    ("hole", "an inner trimming loop of a free-form surface: skipped"),
    ("scrv", "a special curve of a free-form surface: skipped"),
    ("sp", "a special point of a free-form curve or surface: skipped"),
    ("end", "the end of a free-form curve or surface: skipped"),
    ("con", "the connectivity between free-form surfaces: skipped"),
    ("lod", "a level of detail: ignored"),
    ("bevel", "bevel interpolation: ignored"),
    ("c_interp", "color interpolation: ignored"),
    ("d_interp", "opacity interpolation: ignored"),
    ("mg", "a merging group of free-form surfaces: ignored"),
    ("shadow_obj", "a stand-in object for casting shadows: ignored"),
    ("trace_obj", "a stand-in object for ray tracing: ignored"),
    ("maplib", "a library of texture maps: ignored"),
    ("usemap", "a texture map from a library: ignored"),
    ("ctech", "the curve approximation technique: ignored"),
    ("stech", "the surface approximation technique: ignored"),
    ("vw", "a vertex weight: ignored"),
    ("csh", "a shell command: never run, ignored"),
    ("bsp", "a B-spline patch (format before 1995): ignored"),
];

pub(super) fn explain(bytes: &[u8], line: u64) -> Result<LineExplanation, ReadError> {
    let (extent, state) = walk::find(bytes, line)?;
    let mut explanation = blank(bytes, line, extent);
    explanation.in_force = state.in_force();
    let mut cursor = Cursor::at_line(bytes, extent.start, extent.first_line);
    if cursor.next_word() {
        statement(bytes, &mut cursor, &state, extent, &mut explanation);
        describe_extent(&mut explanation);
    } else {
        let is_comment = cursor.peek() == Some(b'#');
        explanation.meaning = if is_comment { "a comment" } else { "an empty line" }.to_owned();
    }
    Ok(explanation)
}

fn statement(bytes: &[u8], cursor: &mut Cursor<'_>, state: &State, extent: Extent, explanation: &mut LineExplanation) {
    let (line, column) = (cursor.line(), cursor.column());
    match cursor.word() {
        b"v" => vertex(cursor, state.counts[0] + 1, explanation),
        b"vt" => tex_coord(cursor, state.counts[1] + 1, explanation),
        b"vn" => normal(cursor, state.counts[2] + 1, explanation),
        b"f" | b"fo" => {
            face::explain(Element { keyword: "f", least: 3 }, bytes, cursor, state, extent, explanation);
        }
        b"l" => face::explain(Element { keyword: "l", least: 2 }, bytes, cursor, state, extent, explanation),
        b"p" => face::explain(Element { keyword: "p", least: 1 }, bytes, cursor, state, extent, explanation),
        b"o" => part(bytes, cursor, "object", extent, explanation),
        b"g" => part(bytes, cursor, "group", extent, explanation),
        b"usemtl" => material(bytes, cursor, state, extent, explanation),
        b"s" => smoothing(bytes, cursor, extent, explanation),
        b"mtllib" => library(cursor, explanation),
        keyword => {
            let known = OTHERS.iter().find(|(known, _)| known.as_bytes() == keyword);
            explanation.meaning = match known {
                Some((_, meaning)) => (*meaning).to_owned(),
                None => "not a known statement: skipped".to_owned(),
            };
            if known.is_none() {
                let message = format!("unknown statement {}", quote(keyword));
                explanation.problems.push(warning(message, line, column));
            }
        }
    }
}

/// Reads the numbers of a statement, at most `most`, up to the first that cannot be read. Reports numbers that the
/// reader rejects.
fn read(
    cursor: &mut Cursor<'_>,
    keyword: &str,
    [least, most]: [usize; 2],
    explanation: &mut LineExplanation,
) -> Vec<f32> {
    let mut values = Vec::new();
    let mut behind_position = None;
    while values.len() < most && cursor.next_word() {
        let (line, column, what) = (cursor.line(), cursor.column(), quote(cursor.offending_word()));
        let message = match cursor.number() {
            Ok(value) => {
                values.push(value);
                continue;
            }
            Err(BadNumber::NotFinite) if keyword == "v" && values.len() >= least => {
                behind_position.get_or_insert((line, column, cursor.skip_not_finite()));
                values.push(0.0);
                continue;
            }
            Err(BadNumber::NotFinite) if keyword == "v" => {
                format!("v has the coordinate {what}, which is not a finite number: export the model again")
            }
            Err(BadNumber::NotFinite) => {
                let message = format!("{keyword} has {what}, which is not a finite number: using 0 instead");
                explanation.problems.push(warning(message, line, column));
                values.push(0.0);
                cursor.skip_not_finite();
                continue;
            }
            Err(BadNumber::Unreadable) => format!("{keyword}: expected a number, found {what}"),
        };
        explanation.problems.push(warning(message, line, column));
        return values;
    }
    if let Some((line, column, what)) = behind_position
        && let Some(message) = not_finite_behind_position(values.len() - least, &what)
    {
        explanation.problems.push(warning(message, line, column));
    }
    if values.len() < least {
        let needed = count(least as u64, "number", "numbers");
        let message = format!("{keyword} ends early: it needs at least {needed}; is the file cut off?");
        explanation.problems.push(warning(message, cursor.line(), cursor.column()));
    }
    values
}

fn vertex(cursor: &mut Cursor<'_>, number: u64, explanation: &mut LineExplanation) {
    let values = read(cursor, "v", [3, 7], explanation);
    let &[x, y, z, ref more @ ..] = values.as_slice() else {
        explanation.meaning = format!("vertex {number} of this file, which cannot be read");
        return;
    };
    explanation.meaning = format!("vertex {number} of this file: x = {x}, y = {y}, z = {z}");
    let (mut weight, mut color) = (None, None);
    match *more {
        [] => {}
        [w] => {
            weight = Some(w);
            explanation.details.push(format!("its weight w = {w} only matters to free-form curves: it is ignored"));
        }
        [_, _] => {
            let message = "v has 5 numbers instead of 3, 4, 6 or 7: the last two are ignored".to_owned();
            explanation.problems.push(Diagnostic::warning(message).at(explanation.first_line, None));
        }
        [r, g, b, ..] => {
            color = Some([r, g, b]);
            explanation.details.push(format!("its color is red {r}, green {g}, blue {b}, encoded as sRGB"));
        }
    }
    explanation.value = Some(LineValue::Vertex { number, position: [x, y, z], weight, color });
}

fn tex_coord(cursor: &mut Cursor<'_>, number: u64, explanation: &mut LineExplanation) {
    let values = read(cursor, "vt", [1, 2], explanation);
    let (u, v) = match *values.as_slice() {
        [u, v, ..] => (u, v),
        [u] => {
            explanation.details.push("v is missing: using 0".to_owned());
            (u, 0.0)
        }
        [] => {
            explanation.meaning = format!("texture coordinate {number} of this file, which cannot be read");
            return;
        }
    };
    explanation.meaning = format!("texture coordinate {number} of this file: u = {u}, v = {v}");
    if cursor.next_word() {
        explanation.details.push("the third component only matters to 3D textures: it is ignored".to_owned());
    }
    explanation.value = Some(LineValue::TexCoord { number, value: [u, v] });
}

fn normal(cursor: &mut Cursor<'_>, number: u64, explanation: &mut LineExplanation) {
    let values = read(cursor, "vn", [3, 3], explanation);
    let &[x, y, z] = values.as_slice() else {
        explanation.meaning = format!("normal {number} of this file, which cannot be read");
        return;
    };
    let written = [x, y, z];
    explanation.meaning = format!("normal {number} of this file: x = {x}, y = {y}, z = {z}");
    let long = DVec3::from(written.map(f64::from));
    let unit = long.normalize_or_zero().as_vec3().to_array();
    if unit == [0.0; 3] {
        let message = "it has zero length: using an averaged normal instead";
        explanation.problems.push(note(message, explanation.first_line, 1));
    } else if (long.length() - 1.0).abs() > 1e-3 {
        explanation.details.push(format!("its length is {:.4}: normalized to {}", long.length(), numbers(&unit)));
    }
    explanation.value = Some(LineValue::Normal { number, written, unit });
}

/// Formats the faces that a statement applies to: `the 12 faces after it, up to line 40,`
fn faces_after(bytes: &[u8], extent: Extent, until: &[Keyword]) -> String {
    let (faces, line) = walk::faces_after(bytes, extent, until);
    let until = line.map_or("to the end of the file".to_owned(), |line| format!("up to line {line}"));
    match faces {
        0 => format!("no face after it, {until},"),
        1 => format!("the one face after it, {until},"),
        faces => format!("the {faces} faces after it, {until},"),
    }
}

fn part(bytes: &[u8], cursor: &mut Cursor<'_>, what: &str, extent: Extent, explanation: &mut LineExplanation) {
    let name = cursor.name();
    let faces = faces_after(bytes, extent, &[Keyword::Object, Keyword::Group]);
    let verb = if faces.starts_with("the ") && !faces.starts_with("the one") { "belong" } else { "belongs" };
    explanation.meaning = match name.is_empty() {
        true => format!("starts an unnamed {what}: {faces} {verb} to it"),
        false => format!("starts the {what} {}: {faces} {verb} to it", named(&name)),
    };
    explanation.value = Some(LineValue::Name { name });
}

fn material(bytes: &[u8], cursor: &mut Cursor<'_>, state: &State, extent: Extent, explanation: &mut LineExplanation) {
    let name = cursor.name();
    let faces = faces_after(bytes, extent, &[Keyword::Material]);
    let verb = if faces.starts_with("the ") && !faces.starts_with("the one") { "have" } else { "has" };
    explanation.meaning = match name.is_empty() {
        true => format!("{faces} {verb} the default material"),
        false => format!("{faces} {verb} the material {}", named(&name)),
    };
    if !name.is_empty() {
        let libraries: Vec<String> =
            state.libraries.iter().map(|(library, line)| format!("{} (line {line})", named(library))).collect();
        explanation.details.push(match libraries.as_slice() {
            [] => "no mtllib precedes it".to_owned(),
            some => format!("it is looked up in {}", some.join(", ")),
        });
    }
    explanation.value = Some(LineValue::Name { name });
}

fn smoothing(bytes: &[u8], cursor: &mut Cursor<'_>, extent: Extent, explanation: &mut LineExplanation) {
    let SmoothingGroup { number: group, problem } = SmoothingGroup::read(cursor);
    explanation.problems.extend(problem.map(|(line, column, message)| warning(message, line, column)));
    let faces = faces_after(bytes, extent, &[Keyword::Smoothing]);
    let is_many = faces.starts_with("the ") && !faces.starts_with("the one");
    explanation.meaning = match group {
        0 => format!("smoothing is off: {faces} {} flat", if is_many { "are" } else { "is" }),
        group => format!("{faces} {} in the smoothing group {group}", if is_many { "are" } else { "is" }),
    };
    explanation.details.push("it only matters where there are no normals (vn)".to_owned());
    explanation.value = Some(LineValue::SmoothingGroup { group });
}

fn library(cursor: &mut Cursor<'_>, explanation: &mut LineExplanation) {
    let (line, name) = (cursor.line(), cursor.name());
    if name.is_empty() {
        let message = "mtllib names no material library";
        explanation.problems.push(Diagnostic::warning(message).at(line, None));
        explanation.meaning = "a material library without a name".to_owned();
        return;
    }
    explanation.meaning = format!("materials are looked up in the library {}", named(&name));
    if name.split_whitespace().nth(1).is_some() {
        explanation.details.push("one file with spaces in its name, or several files".to_owned());
    }
    explanation.value = Some(LineValue::Name { name });
}
