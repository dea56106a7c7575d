//! ASCII STL: `solid NAME`, then `facet normal x y z / outer loop / vertex x y z ... / endloop / endfacet`, then
//! `endsolid NAME`. Case and white space do not matter.

use super::Facets;
use crate::diagnostic::{Reports, Tally};
use crate::polygon::Triangulator;
use crate::text::{BadNumber, Cursor, quote};
use crate::{Limits, ReadError, Severity};

pub(super) fn read(bytes: &[u8], limits: &Limits, reports: &mut Reports) -> Result<Facets, ReadError> {
    let mut reader =
        Reader { facets: Facets::default(), open: Open::default(), anomalies: Anomalies::default(), limits };
    let mut cursor = Cursor::new(bytes);
    while !cursor.at_end() {
        while cursor.next_word() {
            reader.statement(&mut cursor, reports)?;
        }
        cursor.next_line();
    }
    reader.finish(cursor.line(), reports)
}

struct Reader<'a> {
    facets: Facets,
    open: Open,
    anomalies: Anomalies,
    limits: &'a Limits,
}

/// Elements that have not ended.
#[derive(Default)]
struct Open {
    solid: bool,
    facet: bool,
    /// The line of the facet.
    line: u64,
    normal: [f32; 3],
    corners: Vec<[f32; 3]>,
    triangulator: Triangulator,
}

#[derive(Default)]
struct Anomalies {
    polygons: Tally,
    too_short: Tally,
    normals: Tally,
    unended: Tally,
}

impl Reader<'_> {
    fn statement(&mut self, cursor: &mut Cursor<'_>, reports: &mut Reports) -> Result<(), ReadError> {
        let (line, column) = (cursor.line(), cursor.column());
        let word = cursor.word();
        let is = |keyword: &[u8]| word.eq_ignore_ascii_case(keyword);
        if is(b"vertex") {
            let corner = corner(cursor)?;
            self.open.corners.push(corner);
        } else if is(b"facet") {
            self.end_unended_facet()?;
            (self.open.facet, self.open.line) = (true, line);
            self.open.normal = self.normal(cursor);
        } else if is(b"endfacet") {
            self.end_facet()?;
        } else if is(b"solid") {
            self.end_unended_facet()?;
            let first = self.facets.count();
            self.facets.solids.push((cursor.name(), first));
            self.open.solid = true;
        } else if is(b"endsolid") {
            self.end_unended_facet()?;
            cursor.name();
            self.open.solid = false;
        } else if !(is(b"outer") || is(b"loop") || is(b"endloop")) {
            reports.add("unknown statements", Severity::Warning, line, Some(column), || {
                format!("unknown statement {}: the rest of its line is ignored", quote(word))
            });
            cursor.name();
        }
        Ok(())
    }

    /// Reads `normal x y z`; an invalid normal becomes 0.
    fn normal(&mut self, cursor: &mut Cursor<'_>) -> [f32; 3] {
        let line = cursor.line();
        let mut normal = [0.0; 3];
        let mut is_there = cursor.next_word() && cursor.offending_word().eq_ignore_ascii_case(b"normal");
        if is_there {
            cursor.word();
        }
        for value in &mut normal {
            is_there = is_there && cursor.next_word();
            if !is_there {
                break;
            }
            match cursor.number() {
                Ok(number) => *value = number,
                Err(BadNumber::NotFinite) => {
                    *value = f32::NAN;
                    step_over_word(cursor);
                }
                Err(BadNumber::Unreadable) => is_there = false,
            }
        }
        if is_there {
            return normal;
        }
        self.anomalies.normals.add(Some(line), String::new);
        [0.0; 3]
    }

    /// Handles a facet or solid that begins before the last facet ended.
    fn end_unended_facet(&mut self) -> Result<(), ReadError> {
        if self.open.facet {
            self.anomalies.unended.add(Some(self.open.line), String::new);
            return self.end_facet();
        }
        Ok(())
    }

    fn end_facet(&mut self) -> Result<(), ReadError> {
        self.open.facet = false;
        let Open { line, normal, ref corners, ref mut triangulator, .. } = self.open;
        let facets = &mut self.facets;
        let place = || format!("that of line {line}");
        match corners[..] {
            [a, b, c] => drop(facets.add(normal, [a, b, c], Some(line), place)),
            [] | [_] | [_, _] => self.anomalies.too_short.add(Some(line), String::new),
            ref corners if corners.iter().flatten().all(|c| c.is_finite()) => {
                self.anomalies.polygons.add(Some(line), String::new);
                triangulator.triangulate(corners, |triangle| {
                    facets.add(normal, triangle.map(|i| corners[i]), Some(line), place);
                });
            }
            _ => facets.not_finite.add(Some(line), place),
        }
        self.open.corners.clear();
        if facets.count() as u64 > self.limits.max_triangles {
            let most = self.limits.max_triangles;
            return Err(ReadError::new(format!("contains more than {most} facets, which is the limit")));
        }
        Ok(())
    }

    fn finish(mut self, last_line: u64, reports: &mut Reports) -> Result<Facets, ReadError> {
        if self.open.facet {
            let message = "the file ends inside a facet, which is left out: the file is cut off, or damaged";
            reports.warning(self.open.line, message);
        } else if self.open.solid {
            reports.warning(last_line, "the last solid has no endsolid: the file may be cut off");
        }
        let warn = |tally: &Tally, reports: &mut Reports, one: &str, many: &str| {
            tally.report(Severity::Warning, reports, |tally| tally.counted(one, many));
        };
        let anomalies = &self.anomalies;
        warn(&anomalies.unended, reports, "facet has no endfacet", "facets have no endfacet (this is the first)");
        let (one, many) = ("facet has fewer than 3 corners", "facets have fewer than 3 corners");
        warn(
            &anomalies.too_short,
            reports,
            &format!("{one}: left out"),
            &format!("{many} (this is the first): left out"),
        );
        let (one, many) = ("facet has more than 3 corners", "facets have more than 3 corners");
        warn(
            &anomalies.polygons,
            reports,
            &format!("{one}: triangulated"),
            &format!("{many} (this is the first): triangulated"),
        );
        let (one, many) = ("facet has an invalid normal", "facets have an invalid normal");
        let rest = "computed from the corners";
        warn(&anomalies.normals, reports, &format!("{one}: {rest}"), &format!("{many} (this is the first): {rest}"));
        let solids = self.facets.solids.len() as u64;
        self.facets.contents = vec![("solid".to_owned(), solids), ("facet".to_owned(), self.facets.count() as u64)];
        Ok(self.facets)
    }
}

fn corner(cursor: &mut Cursor<'_>) -> Result<[f32; 3], ReadError> {
    let line = cursor.line();
    let mut corner = [0.0; 3];
    for (i, value) in corner.iter_mut().enumerate() {
        if !cursor.next_word() {
            let message = format!("vertex has {i} of 3 coordinates: export the model again");
            return Err(ReadError::new(message).at(line, Some(cursor.column())));
        }
        match cursor.number() {
            Ok(number) => *value = number,
            Err(BadNumber::NotFinite) => {
                *value = f32::NAN;
                step_over_word(cursor);
            }
            Err(BadNumber::Unreadable) => {
                let found = quote(cursor.offending_word());
                let message =
                    format!("vertex has the coordinate {found}, which is not a number: export the model again");
                return Err(ReadError::new(message).at(line, Some(cursor.column())));
            }
        }
    }
    Ok(corner)
}

/// Skips a word that may contain a `#`, such as `1.#QNAN`.
fn step_over_word(cursor: &mut Cursor<'_>) {
    (0..cursor.offending_word().len()).for_each(|_| cursor.advance());
}
