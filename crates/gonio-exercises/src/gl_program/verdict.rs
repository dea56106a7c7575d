//! What a check of a host program says.

use super::names::HostMistakeName;
use super::program::HostError;
use gonio_gl::trace::Finding;
use gonio_render::gl_program::{CallError, GlProgramRun};
use serde::Serialize;

/// The word for it all.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum HostOutcome {
    /// The picture is the exercise's.
    Correct,
    /// It is not.
    Wrong,
    /// The text is no host program, a file is missing, or the shaders do not compile.
    DoesNotCompile,
}

/// A mistake: with it mended, the picture is right.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct HostMistake {
    /// Its word, one of `names`.
    pub id: String,
    /// What is wrong, in half a sentence.
    pub name: String,
    /// What exactly is wrong in this line, and why that matters.
    pub explanation: String,
    /// What it looks like.
    pub looks_like: String,
    /// What exactly to write.
    pub mend: String,
    /// The line that is wrong; where a call is missing, the one after which it is.
    pub line: u32,
    /// The line itself.
    pub quoted: String,
}

/// Right, but worth knowing.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct HostWarning {
    /// Its line, where it has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub line: Option<u32>,
    /// A sentence without its end.
    pub text: String,
}

/// What a check says.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct HostVerdict {
    /// The file's name.
    pub file: String,
    /// The word for it all.
    pub verdict: HostOutcome,
    /// In one sentence.
    pub summary: String,
    /// What is wrong: all of these together explain the picture. Empty where nothing does.
    pub mistakes: Vec<HostMistake>,
    /// What the frame panel shows of it.
    pub findings: Vec<Finding>,
    /// Why it does not compile.
    pub errors: Vec<HostError>,
    /// Calls that OpenGL refused.
    pub refused: Vec<CallError>,
    /// Right, but worth knowing.
    pub warnings: Vec<HostWarning>,
    /// The share of pixels that are as they should be, 0 to 1.
    pub share_right: f64,
    /// What came of the program: the picture, and the record for the frame panel.
    #[serde(skip)]
    pub run: Option<GlProgramRun>,
    /// The picture that it should be, of the same size and order.
    #[serde(skip)]
    pub reference: Vec<[f32; 4]>,
}

impl HostVerdict {
    /// Of what is no program.
    pub(super) fn broken(file: &str, errors: Vec<HostError>) -> Self {
        let more = errors.len().saturating_sub(1);
        let first = errors.first().map_or(String::new(), |error| format!("line {}: {}", error.line, error.message));
        let summary = if more == 0 { first } else { format!("{first}, and {more} more") };
        HostVerdict {
            file: file.to_owned(),
            verdict: HostOutcome::DoesNotCompile,
            summary,
            mistakes: Vec::new(),
            findings: Vec::new(),
            errors,
            refused: Vec::new(),
            warnings: Vec::new(),
            share_right: 0.0,
            run: None,
            reference: Vec::new(),
        }
    }
}

impl HostMistake {
    pub(super) fn new(words: &HostMistakeName, said: &str, mend: &str, line: u32, quoted: &str) -> Self {
        HostMistake {
            id: words.id.to_owned(),
            name: words.name.to_owned(),
            explanation: format!("{said}. {}", words.explanation),
            looks_like: words.looks_like.to_owned(),
            mend: mend.to_owned(),
            line,
            quoted: quoted.to_owned(),
        }
    }
}
