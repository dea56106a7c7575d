//! Why a GL program gives no picture at all: at its line, or at the shader's.

use super::program::{GlProgram, GlProgramError};
use gonio_check::nearest::nearest;
use gonio_render::gl_program::{GlProgramFailure, GlProgramFiles};

/// Errors of a failure.
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
                Some(known) => format!("did you mean `{known}`?"),
                None => format!("there are {}", known.join(", ")),
            };
            vec![own(*line, format!("there is no file `{}`", super::reader::shown(file)), help)]
        }
        GlProgramFailure::Shaders { line, vertex, fragment, broken } => {
            let mut errors = Vec::new();
            for (file, log) in [(vertex, &broken.vertex_log), (fragment, &broken.fragment_log)] {
                errors.extend(log.iter().flat_map(|log| of_log(file, log)));
            }
            if let Some(log) = &broken.link_log {
                let message = format!("`{vertex}` and `{fragment}` do not link: {}", log.trim());
                errors.push(own(*line, message, "names and types of what one gives the other must agree".to_owned()));
            }
            if errors.is_empty() {
                let why = broken.driver.clone().unwrap_or_else(|| "OpenGL made no program of the shaders".to_owned());
                errors.push(own(*line, why, String::new()));
            }
            errors
        }
        GlProgramFailure::Driver(error) => vec![own(1, error.message.clone(), String::new())],
    }
}

/// The errors of a compiler's log.
fn of_log(file: &str, log: &str) -> Vec<GlProgramError> {
    let mut errors: Vec<GlProgramError> = Vec::new();
    for text in log.lines().map(str::trim).filter(|line| !line.is_empty()).take(super::program::MOST_ERRORS) {
        let (line, column, message) = place(text);
        let is_warning = message.to_lowercase().starts_with("warning");
        if line > 0 && !is_warning {
            let message = message.trim_start_matches("error: ").to_owned();
            errors.push(GlProgramError { file: file.to_owned(), line, column, message, help: String::new() });
        }
    }
    if errors.is_empty() {
        let message = format!("it does not compile: {}", log.trim());
        errors.push(GlProgramError { file: file.to_owned(), line: 1, column: 1, message, help: String::new() });
    }
    errors
}

/// Line, column and message of `0:12(5): error: ...` (Mesa), `0(12) : error ...` (NVIDIA), `ERROR: 0:12: ...` (others).
/// The line is 0 where there is none.
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
