//! The findings about a GL program.

use super::names::GlProgramMistakeName;
use super::program::GlProgramError;
use gonio_check::verdict::Outcome;
use gonio_gl::trace::Finding;
use gonio_render::gl_program::{CallError, GlProgramRun};
use serde::Serialize;

/// A mistake: with it fixed, the picture is right.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct GlProgramMistake {
    /// Its word, one of `names`.
    pub id: String,
    /// The mistake in half a sentence.
    pub name: String,
    /// The error in this line and its effect.
    pub explanation: String,
    /// The symptom in the picture.
    pub looks_like: String,
    /// The exact text to write.
    pub fix: String,
    /// The line that is wrong; where a call is missing, the one after which it is.
    pub line: u32,
    /// The line itself.
    pub quoted: String,
}

/// Right, but worth knowing.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct GlProgramWarning {
    /// Its line, where it has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub line: Option<u32>,
    /// A sentence without its end.
    pub text: String,
}

/// The result of a check.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct GlProgramFindings {
    /// The file's name.
    pub file: String,
    /// The outcome of a check.
    pub verdict: Outcome,
    /// In one sentence.
    pub summary: String,
    /// The mistakes that together explain the picture; empty if nothing does.
    pub mistakes: Vec<GlProgramMistake>,
    /// The findings about the frame, as the frame panel shows them.
    pub findings: Vec<Finding>,
    /// Why it does not compile.
    pub errors: Vec<GlProgramError>,
    /// Calls that OpenGL refused.
    pub refused: Vec<CallError>,
    /// Right, but worth knowing.
    pub warnings: Vec<GlProgramWarning>,
    /// The share of pixels that are as they should be, 0 to 1.
    pub share_right: f64,
    /// The result of running the program: the picture, and the trace for the frame panel.
    #[serde(skip)]
    pub run: Option<GlProgramRun>,
    /// The picture that it should be, of the same size and order.
    #[serde(skip)]
    pub reference: Vec<[f32; 4]>,
}

impl GlProgramFindings {
    /// The findings for a text that is not a program.
    pub(super) fn broken(file: &str, errors: Vec<GlProgramError>) -> Self {
        let more = errors.len().saturating_sub(1);
        let first = errors.first().map_or(String::new(), |error| format!("line {}: {}", error.line, error.message));
        let summary = if more == 0 { first } else { format!("{first}, and {more} more") };
        GlProgramFindings {
            file: file.to_owned(),
            verdict: Outcome::DoesNotCompile,
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

impl GlProgramMistake {
    pub(super) fn new(words: &GlProgramMistakeName, said: &str, fix: &str, line: u32, quoted: &str) -> Self {
        GlProgramMistake {
            id: words.id.to_owned(),
            name: words.name.to_owned(),
            explanation: format!("{said}. {}", words.explanation),
            looks_like: words.looks_like.to_owned(),
            fix: fix.to_owned(),
            line,
            quoted: quoted.to_owned(),
        }
    }
}
