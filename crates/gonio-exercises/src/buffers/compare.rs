//! Compares a student's buffer with a model, and explains the difference.

use super::buffer::{Attributes, Buffer, Reading, Vertex};
use super::expected::{Expected, Hypothesis};
use super::fit::{Fit, SubmittedTriangles, closed_key, corner_keys, fit, matches};
use super::keys::{join, triangle};
use super::mistakes::{MISTAKES, Mistake};
use super::same::{self, Left};
use gonio_check::verdict::Outcome;
use gonio_language::tr;
use serde::Serialize;

/// The share that a mistake must explain to be named: triangles in both buffers divided by those in either. The exercise
/// sets it.
const ENOUGH: f64 = 0.95;

/// Tolerance for numbers with too few digits, relative like [`super::keys::TOLERANCE`].
const FEW_DIGITS: f64 = 5e-3;

/// The result of comparing a buffer with a model.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BufferFindings {
    /// The outcome.
    pub verdict: Outcome,
    /// Mistakes that together explain the difference; empty if no known ones do.
    pub mistakes: Vec<BufferMistake>,
    /// Other explanations that fit exactly as well on this model, each as the ids of its mistakes.
    pub alternatives: Vec<Vec<&'static str>>,
    /// Peculiarities that are not mistakes, one sentence each.
    pub warnings: Vec<String>,
    /// A triangle that differs, if there is one.
    pub example: Option<Example>,
    /// The shares of the buffer that are right.
    pub shares: Shares,
}

/// A mistake in a buffer.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BufferMistake {
    /// Stable id, in kebab-case: one of [`super::names`].
    pub id: &'static str,
    /// The title.
    pub name: &'static str,
    /// The behaviour of the program, and the consequence.
    pub explanation: &'static str,
    /// The change that fixes it.
    pub how_to_fix: &'static str,
    /// The share of the difference that it explains, together with the other mistakes named: 1 for all.
    pub share_explained: f64,
    /// A triangle that shows it.
    pub example: Option<Example>,
}

/// A triangle of the student's buffer, and the expected one.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Example {
    /// Row of the first vertex in the buffer, from 1; `None` if the triangle is missing.
    pub row: Option<u64>,
    /// The vertices in the buffer.
    pub given: Option<[Vertex; 3]>,
    /// The expected vertices; `None` if none of the model's triangles corresponds to it.
    pub expected: Option<[Vertex; 3]>,
    /// The line of the model with the face, from 1.
    pub line: Option<u64>,
    /// The text of that line.
    pub line_text: String,
}

/// The shares of a buffer that are right: matching triangles divided by the triangles of the larger buffer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Shares {
    /// Number of triangles of the model.
    pub triangles_expected: u64,
    /// Number of triangles of the buffer.
    pub triangles_given: u64,
    /// All compared attributes.
    pub all: f64,
    /// Positions alone.
    pub positions: f64,
    /// Texture coordinates alone; `None` if the model or the buffer has none.
    pub tex_coords: Option<f64>,
    /// Normals alone; `None` if the model or the buffer has none.
    pub normals: Option<f64>,
}

/// Compares a buffer with what gonio-mesh reads.
pub fn compare(expected: &Expected, buffer: &Buffer) -> BufferFindings {
    let reading = likely_reading(expected, buffer);
    let mut comparison = Comparison::new(expected, &reading);
    comparison.warnings.extend(buffer.warnings.iter().cloned());
    comparison.warnings.extend(reading.remark.map(|id| tr!(id).to_owned()));
    comparison.verdict()
}

/// The model that a buffer belongs to: the one with the same file name, otherwise the most similar one; `None` if there are
/// no models. Each model is its file name and its expected buffer.
pub fn choose<'a>(models: &'a [(String, Expected)], name: &str, buffer: &Buffer) -> Option<&'a (String, Expected)> {
    let stem = |name: &str| {
        let name = name.rsplit(['/', '\\']).next().unwrap_or_default();
        name.rsplit_once('.').map_or(name, |(stem, _)| stem).to_ascii_lowercase()
    };
    let stem_of_buffer = stem(name);
    models.iter().find(|(name, _)| stem(name) == stem_of_buffer).or_else(|| {
        let likeness = |expected: &Expected| {
            let reading = likely_reading(expected, buffer);
            let [all, positions] = [true, false].map(|all| {
                let compared = if all { expected.has.and(reading.has) } else { Attributes::default() };
                let given = SubmittedTriangles::new(&triangles_of(&reading), &expected.keys, compared);
                share_of(&expected_keys(expected, compared), &given)
            });
            all + positions + 1e-3 * known(expected, &reading)
        };
        let scored = models.iter().map(|model| (likeness(&model.1), model));
        scored.reduce(|best, next| if next.0 > best.0 { next } else { best }).map(|(_, model)| model)
    })
}

fn known(expected: &Expected, reading: &Reading) -> f64 {
    expected.keys.share_known(&reading.vertices, expected.has.and(reading.has))
}

/// The interpretation of the columns that is most similar to the model; the first if several are.
fn likely_reading(expected: &Expected, buffer: &Buffer) -> Reading {
    let score = |reading: &Reading| {
        let compared = expected.has.and(reading.has);
        let given = SubmittedTriangles::new(&triangles_of(reading), &expected.keys, compared);
        let right = share_of(&expected_keys(expected, compared), &given);
        let has_all_rows = reading.vertices.len() == 3 * expected.triangles.len();
        // Matching triangles decide. In a wrong buffer the numbers do, then the number of rows and whether the columns are
        // those of the model.
        let pairs = [(expected.has.tex_coords, reading.has.tex_coords), (expected.has.normals, reading.has.normals)];
        let others = pairs.iter().filter(|(expected, has)| expected != has).count();
        4.0 * right + known(expected, reading) + if has_all_rows { 0.05 } else { 0.0 } - 0.01 * others as f64
    };
    let mut readings = buffer.readings();
    if readings.len() == 1 {
        return readings.remove(0);
    }
    let scored = readings.into_iter().map(|reading| (score(&reading), reading));
    let best = scored.reduce(|best, next| if next.0 > best.0 + 1e-9 { next } else { best });
    best.map_or(Reading { vertices: Vec::new(), has: Attributes::default(), remark: None }, |(_, reading)| reading)
}

fn triangles_of(reading: &Reading) -> Vec<[Vertex; 3]> {
    reading.vertices.as_chunks::<3>().0.to_vec()
}

fn expected_keys(expected: &Expected, compared: Attributes) -> Vec<u64> {
    let key = |corners: &[Vertex; 3]| triangle(corners.map(|vertex| join(expected.keys.vertex(&vertex, compared))));
    let mut keys: Vec<u64> = expected.triangles.iter().map(|triangle| key(&triangle.vertices)).collect();
    keys.sort_unstable();
    keys
}

fn share_of(expected: &[u64], given: &SubmittedTriangles) -> f64 {
    let matched = matches(expected, &given.keys, |_| {});
    matched as f64 / expected.len().max(given.keys.len()).max(1) as f64
}

struct Comparison<'a> {
    expected: &'a Expected,
    compared: Attributes,
    triangles: Vec<[Vertex; 3]>,
    given: SubmittedTriangles,
    /// Mistakes for columns that the model has and the buffer lacks.
    lacking: Vec<&'static Mistake>,
    warnings: Vec<String>,
    shares: Shares,
}

impl<'a> Comparison<'a> {
    fn new(expected: &'a Expected, reading: &Reading) -> Self {
        let compared = expected.has.and(reading.has);
        let triangles = triangles_of(reading);
        let given = SubmittedTriangles::new(&triangles, &expected.keys, compared);
        let mut warnings = Vec::new();
        if !reading.vertices.len().is_multiple_of(3) {
            warnings.push(tr!("check-buffer-the-buffer-has-rows-which-is", count = reading.vertices.len()));
        }
        let lacks = [
            ("tex-coords-missing", expected.has.tex_coords && !reading.has.tex_coords),
            ("normals-missing", expected.has.normals && !reading.has.normals),
        ];
        let lacking = lacks.iter().filter(|(_, lacks)| *lacks);
        let lacking = lacking.filter_map(|(id, _)| MISTAKES.iter().find(|mistake| mistake.id == *id)).collect();
        let mut comparison =
            Comparison { expected, compared, triangles, given, lacking, warnings, shares: Shares::default() };
        comparison.shares = comparison.shares();
        comparison
    }

    fn shares(&self) -> Shares {
        // One attribute at a time: all vertices get the same position.
        let alone = |keep: fn(&Vertex) -> Vertex, compared: Attributes| {
            let blank = |corners: &[Vertex; 3]| corners.map(|vertex| keep(&vertex));
            let given: Vec<[Vertex; 3]> = self.triangles.iter().map(blank).collect();
            let key = |corners: [Vertex; 3]| {
                triangle(corners.map(|vertex| join(self.expected.keys.vertex(&vertex, compared))))
            };
            let mut keys: Vec<u64> = self.expected.triangles.iter().map(|t| key(blank(&t.vertices))).collect();
            keys.sort_unstable();
            share_of(&keys, &SubmittedTriangles::new(&given, &self.expected.keys, compared))
        };
        let nothing = Attributes::default();
        let only_tex_coords = Attributes { tex_coords: true, ..nothing };
        let only_normals = Attributes { normals: true, ..nothing };
        let without_position = |vertex: &Vertex| Vertex { position: [0.0; 3], ..*vertex };
        Shares {
            triangles_expected: self.expected.triangles.len() as u64,
            triangles_given: self.triangles.len() as u64,
            all: share_of(&expected_keys(self.expected, self.compared), &self.given),
            positions: alone(|vertex| *vertex, nothing),
            tex_coords: self.compared.tex_coords.then(|| alone(without_position, only_tex_coords)),
            normals: self.compared.normals.then(|| alone(without_position, only_normals)),
        }
    }

    fn verdict(mut self) -> BufferFindings {
        let left = same::left(self.expected, &self.triangles, &self.given, self.compared);
        if left.is_nothing() {
            return self.only_lacking();
        }
        let coarse = same::loosely(self.expected, &self.triangles, left.clone(), self.compared, FEW_DIGITS);
        if coarse.is_nothing() {
            let warning = tr!("check-buffer-numbers-are-rounded-to-few-digits");
            self.warnings.push(warning.to_owned());
            return self.only_lacking();
        }
        match self.best() {
            Some(best) => self.explained(best, &left),
            None => self.unexplained(&left),
        }
    }

    /// Findings if everything that can be compared is right.
    fn only_lacking(self) -> BufferFindings {
        let verdict = if self.lacking.is_empty() { Outcome::Correct } else { Outcome::Wrong };
        let mistakes = self.lacking.iter().map(|mistake| buffer_mistake(mistake, 1.0, None)).collect();
        BufferFindings {
            verdict,
            mistakes,
            alternatives: Vec::new(),
            warnings: self.warnings,
            example: None,
            shares: self.shares,
        }
    }

    /// The best explanations: those with the fewest mistakes, all that fit equally well.
    fn best(&self) -> Option<Best<'a>> {
        let singles = self.best_of(&self.expected.wrong_buffers(self.compared).singles);
        if singles.as_ref().is_some_and(|best| best.fit.share >= 1.0 && best.fit.open == 0) {
            return singles;
        }
        let pairs = self.best_of(self.expected.pairs(self.compared));
        match (singles, pairs) {
            (Some(singles), Some(pairs))
                if pairs.fit.share > singles.fit.share + 1e-9
                    // An explanation without unknown values comes before one with some.
                    || (pairs.fit.share >= 1.0 && pairs.fit.open == 0) =>
            {
                Some(pairs)
            }
            (None, pairs) => pairs,
            (singles, _) => singles,
        }
    }

    fn best_of(&self, all: &'a [Hypothesis]) -> Option<Best<'a>> {
        let is_exact = |made: &Hypothesis| made.made.open.is_empty() && made.made.print == self.given.print;
        let exact: Vec<&Hypothesis> = all.iter().filter(|hypothesis| is_exact(hypothesis)).collect();
        if !exact.is_empty() {
            return Some(Best { fit: Fit { share: 1.0, open: 0 }, hypotheses: exact });
        }
        let mut best = Best { fit: Fit { share: ENOUGH, open: usize::MAX }, hypotheses: Vec::new() };
        for hypothesis in all {
            let Some(found) = fit(&hypothesis.made, &self.given, best.fit.share - 1e-9) else { continue };
            if found.share > best.fit.share + 1e-9 || found.open < best.fit.open {
                best = Best { fit: found, hypotheses: vec![hypothesis] };
            } else if found.open == best.fit.open {
                best.hypotheses.push(hypothesis);
            }
        }
        (!best.hypotheses.is_empty()).then_some(best)
    }

    fn explained(self, mut best: Best<'a>, left: &Left) -> BufferFindings {
        // Equally good explanations: likely mistakes first, which is the order of the table.
        best.hypotheses.sort_by(|a, b| a.wrong.mistakes.cmp(&b.wrong.mistakes));
        let named = best.hypotheses[0];
        let base = self.shares.all;
        let share = if base < 1.0 { ((best.fit.share - base) / (1.0 - base)).clamp(0.0, 1.0) } else { 1.0 };
        let example = self.example(left, Some(named));
        let mut warnings = self.warnings;
        let mut mistakes: Vec<BufferMistake> =
            self.lacking.iter().map(|mistake| buffer_mistake(mistake, 1.0, None)).collect();
        for mistake in named.wrong.mistakes.iter().filter_map(|number| MISTAKES.get(*number)) {
            if mistake.is_harmless {
                warnings.push(format!("{}: {}", mistake.words().name, mistake.words().explanation));
            } else {
                mistakes.push(buffer_mistake(mistake, share, example.clone()));
            }
        }
        let mut alternatives: Vec<Vec<&'static str>> = Vec::new();
        for other in &best.hypotheses[1..] {
            let ids: Vec<&'static str> = other.wrong.mistakes.iter().map(|number| MISTAKES[*number].id).collect();
            if other.wrong.mistakes != named.wrong.mistakes && !alternatives.contains(&ids) {
                alternatives.push(ids);
            }
        }
        let verdict = if mistakes.is_empty() { Outcome::Correct } else { Outcome::Wrong };
        BufferFindings { verdict, mistakes, alternatives, warnings, example, shares: self.shares }
    }

    fn unexplained(mut self, left: &Left) -> BufferFindings {
        let vertices: Vec<Vertex> = self.triangles.iter().flatten().copied().collect();
        // More than half of the positions' numbers are not in the file.
        let is_foreign = self.expected.keys.share_known(&vertices, Attributes::default()) < 0.5;
        if is_foreign {
            self.warnings.push(tr!("check-buffer-most-of-the-buffer-s-numbers").to_owned());
        }
        let example = self.example(left, None);
        BufferFindings {
            verdict: if is_foreign { Outcome::Unsure } else { Outcome::Wrong },
            mistakes: self.lacking.iter().map(|mistake| buffer_mistake(mistake, 1.0, None)).collect(),
            alternatives: Vec::new(),
            warnings: self.warnings,
            example,
            shares: self.shares,
        }
    }

    /// The first of the student's triangles without a match; if there is none, the first missing one.
    fn example(&self, left: &Left, named: Option<&Hypothesis>) -> Option<Example> {
        let line_of = |face: Option<usize>| face.and_then(|face| self.expected.source.faces.get(face)).map(|f| f.line);
        let text_of =
            |line: Option<u64>| line.and_then(|line| self.expected.source.line(line)).unwrap_or("").to_owned();
        let Some(number) = left.given.iter().min().copied() else {
            let missing = self.expected.triangles.get(*left.expected.first()?)?;
            let line = line_of(missing.face);
            return Some(Example {
                row: None,
                given: None,
                expected: Some(missing.vertices),
                line,
                line_text: text_of(line),
            });
        };
        let key = triangle(self.given.corners[number].map(join));
        let faces = &self.expected.triangles;
        let face = named.and_then(|named| {
            let made = named.wrong.reader.read(&self.expected.source);
            let same = |made: &&super::reader::Triangle| {
                closed_key(&corner_keys(made, &self.expected.keys, self.compared)) == Some(key)
            };
            made.iter().find(same)?.face
        });
        // The missing triangle of that face; otherwise the one in the same place, if the counts are equal.
        let of_face = |face: usize| {
            let missing = left.expected.iter().map(|place| &faces[*place]);
            missing.chain(faces).find(|triangle| triangle.face == Some(face))
        };
        let in_place = || faces.get(number).filter(|_| faces.len() == self.triangles.len());
        let expected = face.and_then(of_face).or_else(in_place);
        let line = line_of(expected.and_then(|triangle| triangle.face));
        Some(Example {
            row: Some(3 * number as u64 + 1),
            given: Some(self.triangles[number]),
            expected: expected.map(|triangle| triangle.vertices),
            line,
            line_text: text_of(line),
        })
    }
}

struct Best<'a> {
    fit: Fit,
    hypotheses: Vec<&'a Hypothesis>,
}

fn buffer_mistake(mistake: &Mistake, share_explained: f64, example: Option<Example>) -> BufferMistake {
    let words = mistake.words();
    BufferMistake {
        id: words.id,
        name: words.name,
        explanation: words.explanation,
        how_to_fix: words.how_to_fix,
        share_explained,
        example,
    }
}
