//! Verdicts: the results of checks, for people and machines.

use crate::mistakes::Mistake;
use gonio_language::tr;
use serde::{Deserialize, Deserializer, Serialize};
use std::borrow::Cow;

/// The outcome of a check.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Outcome {
    /// Right, as the exercise asks or by another method.
    Correct,
    /// Something is wrong, named or not.
    Wrong,
    /// A compiler rejects it.
    DoesNotCompile,
    /// The answer could not be judged; the summary says what is missing.
    Unsure,
}

/// A mistake that was found.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FoundMistake {
    /// The mistake's id in the catalogue.
    pub id: String,
    /// The mistake in half a sentence.
    pub name: String,
    /// The share of the difference that it explains together with the other mistakes, 0 to 1.
    #[serde(deserialize_with = "or_infinite")]
    pub share_explained: f64,
    /// The student's file, if the mistake was located.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    /// The line in that file, from 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub line: Option<u32>,
    /// The text of the line.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub quoted: Option<String>,
    /// The symptom in the picture.
    pub looks_like: String,
    /// How to fix it.
    pub fix: String,
    /// The section of the lecture that teaches it.
    pub lecture_section: String,
    /// Mistakes whose pictures are the same: it may be any of them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub or: Vec<String>,
    /// Whether the lab's own solutions do the same.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub lab_does_it: bool,
}

impl FoundMistake {
    /// Creates a mistake with its id, its name and its share of the difference, 0 to 1.
    pub fn new(id: impl Into<String>, name: impl Into<String>, share_explained: f64) -> Self {
        FoundMistake {
            id: id.into(),
            name: name.into(),
            share_explained,
            file: None,
            line: None,
            quoted: None,
            looks_like: String::new(),
            fix: String::new(),
            lecture_section: String::new(),
            or: Vec::new(),
            lab_does_it: false,
        }
    }

    /// Creates a mistake of the catalogue, with its texts in the current language. The caller, who compared the pictures, adds mistakes that look the same
    /// and whether the lab does it too.
    pub fn from_catalogue(mistake: &Mistake, share_explained: f64) -> Self {
        let texts = mistake.texts();
        let found = FoundMistake::new(&mistake.id, texts.name, share_explained);
        found.taught(texts.looks_like, texts.fix, &mistake.lecture_section)
    }

    /// Adds the symptom, the fix, and the section of the lecture that teaches it.
    pub fn taught(
        self,
        looks_like: impl Into<String>,
        fix: impl Into<String>,
        lecture_section: impl Into<String>,
    ) -> Self {
        FoundMistake { looks_like: looks_like.into(), fix: fix.into(), lecture_section: lecture_section.into(), ..self }
    }

    /// Adds the file, the line from 1 and the text of the line.
    pub fn at(self, file: impl Into<String>, line: Option<u32>, quoted: impl Into<String>) -> Self {
        FoundMistake { file: Some(file.into()), line, quoted: Some(quoted.into()), ..self }
    }
}

/// The state of a term of the equation that was tested alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum TermState {
    /// The same as in the reference.
    Right,
    /// Different from the reference.
    Wrong,
    /// Its strength is not an input, so it cannot be tested alone.
    NotSeparable,
}

/// The verdict on a term.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct TermVerdict {
    /// `ambient`, `diffuse` or `specular`.
    pub term: Cow<'static, str>,
    /// The state.
    pub state: TermState,
}

/// The verdict on a test scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SceneVerdict {
    /// The id of the test scene.
    pub scene: String,
    /// The reason for this scene: what it shows that others do not.
    pub shows: Cow<'static, str>,
    /// Whether the pictures are the same.
    pub right: bool,
    /// The share of the object's pixels that differ by more than a step of 8 bits.
    #[serde(deserialize_with = "or_infinite")]
    pub pixels_beyond: f64,
    /// The largest difference of a channel, 0 to 1.
    #[serde(deserialize_with = "or_infinite")]
    pub worst: f32,
}

/// A message of a compiler, at the student's own line.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct CompilerMessage {
    /// The student's file.
    pub file: String,
    /// Counted from 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub line: Option<u32>,
    /// Counted from 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub column: Option<u32>,
    /// The text of the message.
    pub text: String,
    /// The text of the line.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub quoted: Option<String>,
    /// The explanation.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub explanation: Option<String>,
}

/// A change of one piece of a student's file. All changes of a verdict together make every test scene right.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct ProposedEdit {
    /// The student's file.
    pub file: String,
    /// The first line that changes, from 1.
    pub line: u32,
    /// The old lines as a whole, without the last line break.
    pub before: String,
    /// The new lines as a whole, without the last line break.
    pub after: String,
}

/// A variable of the program and its role.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct BoundVariable {
    /// Its name in OpenGL.
    pub name: String,
    /// Its type.
    #[serde(rename = "type")]
    pub glsl_type: String,
    /// Its role; `None` if unrecognised, and set to 0.
    pub role: Option<String>,
}

/// The result of a check.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Verdict {
    /// The id of the exercise.
    pub exercise: String,
    /// The outcome of a check.
    pub verdict: Outcome,
    /// The verdict in one sentence.
    pub summary: String,
    /// The mistakes, the most significant first.
    pub mistakes: Vec<FoundMistake>,
    /// Peculiarities that are right but worth knowing.
    pub peculiarities: Vec<Peculiarity>,
    /// Problems that may occur on other drivers.
    pub warnings: Vec<String>,
    /// Changes of the student's files with which every test scene is right, compiled and drawn before they were
    /// proposed; empty if none was found. They belong together.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub proposed_fix: Vec<ProposedEdit>,
    /// The verdicts on single terms.
    pub terms: Vec<TermVerdict>,
    /// The verdicts on test scenes.
    pub scenes: Vec<SceneVerdict>,
    /// Properties that need no reference, tested on programs that compute light.
    #[serde(default)]
    pub properties: Vec<PropertyVerdict>,
    /// Messages of the compiler, if it does not compile.
    pub messages: Vec<CompilerMessage>,
    /// Variables and their roles.
    pub bound: Vec<BoundVariable>,
    /// 1 for right answers; for wrong ones the share of test scenes that are right; 0 if it does not compile.
    #[serde(deserialize_with = "or_infinite")]
    pub score: f64,
    /// The points, where a teacher states some; [`Verdict::score`] is their share then.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub points: Option<AwardedPoints>,
}

/// The points of an answer.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct AwardedPoints {
    /// Those of this answer, with at most two decimals.
    pub earned: f64,
    /// Those of a right one.
    pub most: f64,
}

/// The state of a property that every light equation has.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PropertyState {
    /// The program has it.
    Right,
    /// The program does not have it.
    Wrong,
    /// The quantity that would have to be varied is not an input of the program.
    NotApplicable,
}

/// The result of a test with the student's program alone, without a reference.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct PropertyVerdict {
    /// A stable id in kebab-case.
    pub id: String,
    /// The property, or its violation, in one sentence.
    pub sentence: String,
    /// The state of the property.
    pub state: PropertyState,
    /// The test scenes in which it is violated.
    pub scenes: Vec<String>,
}

/// Something right that is done by another method.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Peculiarity {
    /// The mistake's id in the catalogue.
    pub id: String,
    /// The peculiarity in half a sentence.
    pub name: String,
}

/// Joins the names of several mistakes into one summary.
pub fn join_names<'a>(names: impl IntoIterator<Item = &'a str>) -> String {
    names.into_iter().collect::<Vec<_>>().join(tr!("check-also"))
}

impl Verdict {
    /// Returns the names of all mistakes as a summary.
    pub fn mistake_names(&self) -> String {
        join_names(self.mistakes.iter().map(|mistake| mistake.name.as_str()))
    }

    /// Creates a verdict with only an outcome and a summary.
    pub fn new(exercise: &str, verdict: Outcome, summary: impl Into<String>) -> Self {
        Verdict {
            exercise: exercise.to_owned(),
            verdict,
            summary: summary.into(),
            mistakes: Vec::new(),
            peculiarities: Vec::new(),
            warnings: Vec::new(),
            proposed_fix: Vec::new(),
            terms: Vec::new(),
            scenes: Vec::new(),
            properties: Vec::new(),
            messages: Vec::new(),
            bound: Vec::new(),
            score: if verdict == Outcome::Correct { 1.0 } else { 0.0 },
            points: None,
        }
    }

    /// Creates the verdict on a check that was stopped after a number of seconds.
    pub fn endless(exercise: &str, seconds: u64) -> Self {
        let summary = tr!("check-the-check-did-not-finish-within", seconds = seconds);
        Verdict::new(exercise, Outcome::Unsure, summary)
    }

    /// Creates the verdict on a check whose process crashed.
    pub fn crashed(exercise: &str) -> Self {
        let summary = tr!("check-the-check-crashed-the-graphics-driver");
        Verdict::new(exercise, Outcome::Unsure, summary)
    }

    /// Creates the verdict on a check that was stopped because of its memory use.
    pub fn too_large(exercise: &str) -> Self {
        let summary = tr!("check-the-check-was-stopped-because-it");
        Verdict::new(exercise, Outcome::Unsure, summary)
    }
}

/// Reads a number. JSON has no infinity and no NaN: `null` is written for them.
fn or_infinite<'de, T, D>(deserializer: D) -> Result<T, D::Error>
where
    T: Deserialize<'de> + From<f32>,
    D: Deserializer<'de>,
{
    Ok(Option::<T>::deserialize(deserializer)?.unwrap_or_else(|| T::from(f32::INFINITY)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_verdict_survives_a_round_trip() {
        let mut verdict = Verdict::new("ex04", Outcome::Wrong, "The normal is not transformed");
        let found = FoundMistake::new("normal-raw", "The normal is not transformed", 0.997);
        let found = found.taught("the light turns with the model", "multiply", "3.1");
        verdict.mistakes = vec![found.clone().at("a.vert", Some(3), "v = normal;"), found];
        verdict.terms = vec![TermVerdict { term: "diffuse".into(), state: TermState::NotSeparable }];
        let (before, after) = ("v = normal;".to_owned(), "v = normals * normal;".to_owned());
        verdict.proposed_fix = vec![ProposedEdit { file: "a.vert".to_owned(), line: 3, before, after }];
        let scene = |worst| SceneVerdict {
            scene: "lab".into(),
            shows: "the lab's own".into(),
            right: false,
            pixels_beyond: 0.25,
            worst,
        };
        verdict.scenes = vec![scene(0.5)];
        let read = |verdict: &Verdict| {
            serde_json::from_str::<Verdict>(&serde_json::to_string(verdict).unwrap_or_default())
                .map_err(|e| e.to_string())
        };
        assert_eq!(read(&verdict), Ok(verdict.clone()));
        // Verdicts that were stored without these keys are still read.
        verdict.proposed_fix.clear();
        assert!(!serde_json::to_string(&verdict).unwrap().contains("proposed_fix"));
        assert_eq!(read(&verdict), Ok(verdict.clone()));
        // NaN, the result of 0 / 0, has no JSON number.
        verdict.scenes = vec![scene(f32::NAN)];
        assert_eq!(read(&verdict).map(|read| read.scenes[0].worst), Ok(f32::INFINITY));
    }
}
