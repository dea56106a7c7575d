//! The findings about a GL program: mistakes, warnings, and errors that leave no picture.

use super::names::GlProgramMistakeName;
use super::program::{GlProgram, GlProgramError, MOST_ERRORS};
use super::signature::shown;
use gonio_check::verdict::Outcome;
use gonio_check::words::nearest;
use gonio_gl::trace::{Finding, Rule, Severity};
use gonio_language::tr;
use gonio_render::gl_program::{CallError, GlCall, GlProgramFailure, GlProgramFiles, GlProgramRun, Selector};
use serde::Serialize;

/// A mistake: with it fixed, the picture is right.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct GlProgramMistake {
    /// Its id, one of [`super::names()`].
    pub id: String,
    /// The mistake in half a sentence.
    pub name: String,
    /// The error in this line and its effect.
    pub explanation: String,
    /// The symptom in the picture.
    pub looks_like: String,
    /// The exact text to write.
    pub fix: String,
    /// The wrong line; if a call is missing, the line after which it belongs.
    pub line: u32,
    /// The text of the line.
    pub quoted: String,
}

/// A remark about something that is right, but worth knowing.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct GlProgramWarning {
    /// Its line, if it concerns one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub line: Option<u32>,
    /// A sentence without its full stop.
    pub text: String,
}

/// The result of a check.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct GlProgramFindings {
    /// The file's name.
    pub file: String,
    /// The outcome of a check.
    pub verdict: Outcome,
    /// The result in one sentence.
    pub summary: String,
    /// The mistakes that together explain the picture; empty if none do.
    pub mistakes: Vec<GlProgramMistake>,
    /// The findings about the frame, as the frame panel shows them.
    pub findings: Vec<Finding>,
    /// Errors in the text or in the shaders.
    pub errors: Vec<GlProgramError>,
    /// Calls that OpenGL rejected.
    pub refused: Vec<CallError>,
    /// Remarks about what is right, but worth knowing.
    pub warnings: Vec<GlProgramWarning>,
    /// The share of right pixels, from 0 to 1.
    pub share_right: f64,
    /// The result of running the program: the picture, and the trace for the frame panel.
    #[serde(skip)]
    pub run: Option<GlProgramRun>,
    /// The reference's picture, with the same size and order.
    #[serde(skip)]
    pub reference: Vec<[f32; 4]>,
}

impl GlProgramFindings {
    /// The findings for a text that is not a program.
    pub(super) fn broken(file: &str, errors: Vec<GlProgramError>) -> Self {
        let more = errors.len().saturating_sub(1);
        let first = errors
            .first()
            .map_or(String::new(), |error| tr!("check-gl-line-of-error", line = error.line, message = error.message));
        let summary = if more == 0 { first } else { tr!("check-gl-and-more", first = first, more = more) };
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
    pub(super) fn new(words: &GlProgramMistakeName, message: &str, fix: &str, line: u32, quoted: &str) -> Self {
        GlProgramMistake {
            id: words.id.to_owned(),
            name: words.name().to_owned(),
            explanation: format!("{message}. {}", words.explanation()),
            looks_like: words.looks_like().to_owned(),
            fix: fix.to_owned(),
            line,
            quoted: quoted.to_owned(),
        }
    }
}

/// The errors that a failure to run a program means, at a line of the program or of a shader.
pub fn errors(failure: &GlProgramFailure, program: &GlProgram, files: &GlProgramFiles) -> Vec<GlProgramError> {
    let own = |line: u32, message: String, help: String| GlProgramError {
        file: program.file.clone(),
        line,
        column: 1,
        message,
        help,
    };
    match failure {
        GlProgramFailure::MissingFile { line, file } => {
            let known: Vec<&str> = files.shaders.keys().chain(files.images.keys()).map(String::as_str).collect();
            let help = match nearest(file, known.iter().copied()) {
                Some(known) => tr!("check-gl-did-you-mean", known = known),
                None => tr!("check-gl-the-files-are", files = known.join(", ")),
            };
            vec![own(*line, tr!("check-gl-unknown-file", file = shown(file)), help)]
        }
        GlProgramFailure::Shaders { line, vertex, fragment, broken } => {
            let mut errors = Vec::new();
            for (file, log) in [(vertex, &broken.vertex_log), (fragment, &broken.fragment_log)] {
                errors.extend(log.iter().flat_map(|log| of_log(file, log)));
            }
            if let Some(log) = &broken.link_log {
                let message = tr!("check-gl-and-do-not-link", vertex = vertex, fragment = fragment, log = log.trim());
                errors.push(own(*line, message, tr!("check-gl-the-outputs-of-the-vertex-shader").to_owned()));
            }
            if errors.is_empty() {
                let message = broken
                    .driver
                    .clone()
                    .unwrap_or_else(|| tr!("check-gl-opengl-could-not-create-a-program").to_owned());
                errors.push(own(*line, message, String::new()));
            }
            errors
        }
        GlProgramFailure::Driver(error) => vec![own(1, error.message.clone(), String::new())],
    }
}

/// The errors of a compiler's log.
fn of_log(file: &str, log: &str) -> Vec<GlProgramError> {
    let mut errors: Vec<GlProgramError> = Vec::new();
    for text in log.lines().map(str::trim).filter(|line| !line.is_empty()).take(MOST_ERRORS) {
        let (line, column, message) = place(text);
        let is_warning = message.to_lowercase().starts_with("warning");
        if line > 0 && !is_warning {
            let message = message.trim_start_matches("error: ").to_owned();
            errors.push(GlProgramError { file: file.to_owned(), line, column, message, help: String::new() });
        }
    }
    if errors.is_empty() {
        let message = tr!("check-gl-the-shader-does-not-compile", log = log.trim());
        errors.push(GlProgramError { file: file.to_owned(), line: 1, column: 1, message, help: String::new() });
    }
    errors
}

/// Line, column and message of `0:12(5): error: ...` (Mesa), `0(12) : error ...` (NVIDIA), `ERROR: 0:12: ...` (others).
/// The line is 0 if there is none.
fn place(text: &str) -> (u32, u32, &str) {
    let rest = text.strip_prefix("ERROR: ").unwrap_or(text);
    let digits = rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len());
    let rest = &rest[digits..];
    let Some(rest) = rest.strip_prefix([':', '(']) else { return (0, 1, text) };
    let (line, rest) = number(rest);
    let (column, rest) = match rest.strip_prefix('(') {
        Some(inner) => number(inner),
        None => (1, rest),
    };
    (line, column.max(1), rest.trim_start_matches([')', ':', ' ']))
}

fn number(text: &str) -> (u32, &str) {
    let end = text.find(|c: char| !c.is_ascii_digit()).unwrap_or(text.len());
    (text[..end].parse().unwrap_or(0), &text[end..])
}

/// Warnings about a program that runs here, but may not elsewhere. If the picture is wrong, only warnings unrelated to that.
pub fn warnings(program: &GlProgram, run: &GlProgramRun, right: bool) -> Vec<GlProgramWarning> {
    let mut warnings = Vec::new();
    if right {
        // Rejected calls are reported below, at their own lines.
        for finding in run.findings.iter().filter(|finding| finding.rule != Rule::OpenGlError) {
            let line = run.draw_lines.get(finding.draw).copied();
            let text = match finding.severity {
                Severity::Warning => format!("{} ({})", finding.message, finding.advice),
                Severity::Error => tr!("check-gl-although-the-picture-is-right", message = finding.message),
            };
            warnings.push(GlProgramWarning { line, text });
        }
        for error in &run.errors {
            let text = tr!("check-gl-opengl-rejects-with", call = error.call, code = error.code, why = error.why);
            warnings.push(GlProgramWarning { line: Some(error.line), text });
        }
    }
    depth_never_cleared(program, &mut warnings);
    dark_edges(program, &mut warnings);
    unknown_uniforms(program, run, &mut warnings);
    warnings
}

/// A real program draws many frames: in the second one, the depths of the first are still there.
fn depth_never_cleared(program: &GlProgram, warnings: &mut Vec<GlProgramWarning>) {
    let on = program
        .steps
        .iter()
        .find(|s| matches!(&s.call, GlCall::Switch { what, on: true } if what.name == "DEPTH_TEST"));
    let cleared = program
        .steps
        .iter()
        .any(|step| matches!(&step.call, GlCall::Clear(bits) if bits.iter().any(|bit| bit.name == "DEPTH_BUFFER_BIT")));
    if let (Some(step), false) = (on, cleared) {
        let text = tr!("check-gl-depth-test-is-enabled-but-no").to_owned();
        warnings.push(GlProgramWarning { line: Some(step.line), text });
    }
}

/// OpenGL ignores them without an error.
fn unknown_uniforms(program: &GlProgram, run: &GlProgramRun, warnings: &mut Vec<GlProgramWarning>) {
    let Some(drawn) = run.record.draws.last().and_then(|draw| run.record.program_of(draw)) else { return };
    for step in &program.steps {
        let GlCall::Uniform { uniform, .. } = &step.call else { continue };
        let bare = uniform.strip_suffix("[0]").unwrap_or(uniform);
        if !drawn.uniforms.iter().any(|known| known.name == bare) {
            let text = tr!("check-gl-the-program-has-no-uniform-and", uniform = uniform);
            warnings.push(GlProgramWarning { line: Some(step.line), text });
        }
    }
}

/// The edges are not visible if the coordinates end with the triangle.
fn dark_edges(program: &GlProgram, warnings: &mut Vec<GlProgramWarning>) {
    for step in &program.steps {
        let GlCall::TexParameter { value: Selector::Constant(value), .. } = &step.call else { continue };
        if value.name == "CLAMP_TO_BORDER" {
            let text = tr!("check-gl-clamp-to-border-mixes-the-border").to_owned();
            warnings.push(GlProgramWarning { line: Some(step.line), text });
        }
    }
}
