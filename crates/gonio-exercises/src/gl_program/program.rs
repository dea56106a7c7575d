//! The text of a GL program, read into its calls: one call on a line, words separated by spaces.

use super::signature::{self, LineError, Named, WORDS, Word, is_name, shown};
use gonio_language::tr;
use gonio_render::gl_program::{GlCall, Step};
use serde::Serialize;
use std::collections::HashMap;
use std::fmt;

/// Maximum number of calls of a GL program.
pub const MOST_CALLS: usize = 1000;
/// Maximum size of its text, in bytes.
pub const MOST_TEXT_BYTES: usize = 4 << 20;
/// Maximum size of a list of numbers, in bytes.
pub const MOST_DATA_BYTES: usize = 1 << 20;
/// Maximum number of errors that are reported at once.
pub const MOST_ERRORS: usize = 50;

/// A GL program that was read.
#[derive(Clone, Debug, PartialEq)]
pub struct GlProgram {
    /// The file's name.
    pub file: String,
    /// Its calls, in order.
    pub steps: Vec<Step>,
    /// Its lines, for quoting.
    lines: Vec<String>,
}

/// An error in the text of a GL program.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct GlProgramError {
    /// The file's name.
    pub file: String,
    /// Line, from 1.
    pub line: u32,
    /// Column in characters, from 1.
    pub column: u32,
    /// The error, a sentence without its full stop.
    pub message: String,
    /// How to fix it; may be empty.
    pub help: String,
}

impl fmt::Display for GlProgramError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}:{}: {}", self.file, self.line, self.column, self.message)?;
        if self.help.is_empty() { Ok(()) } else { write!(f, "; {}", self.help) }
    }
}

impl std::error::Error for GlProgramError {}

impl GlProgram {
    /// Reads a text.
    ///
    /// # Errors
    /// All errors in the text, up to [`MOST_ERRORS`]; never an empty list.
    pub fn parse(text: &str, file_name: &str) -> Result<Self, Vec<GlProgramError>> {
        let error = |message: String, help: &str| {
            vec![GlProgramError { file: file_name.to_owned(), line: 1, column: 1, message, help: help.to_owned() }]
        };
        if text.len() > MOST_TEXT_BYTES {
            let most = MOST_TEXT_BYTES >> 20;
            return Err(error(
                tr!("check-gl-the-text-has-bytes", count = text.len()),
                &tr!("check-gl-at-most-mb-are-read", most = most),
            ));
        }
        if text.contains('\0') {
            return Err(error(
                tr!("check-gl-the-file-is-not-text").to_owned(),
                tr!("check-gl-hand-in-the-gl-program-as"),
            ));
        }
        let steps = read(text, file_name)?;
        let lines = text.lines().map(str::to_owned).collect();
        Ok(GlProgram { file: file_name.to_owned(), steps, lines })
    }

    /// Reads a file's bytes.
    pub fn parse_bytes(bytes: &[u8], file_name: &str) -> Result<Self, Vec<GlProgramError>> {
        // A byte order mark is not a mistake.
        let bytes = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
        match std::str::from_utf8(bytes) {
            Ok(text) => Self::parse(text, file_name),
            Err(error) => {
                let line = bytes[..error.valid_up_to()].iter().filter(|byte| **byte == b'\n').count() as u32 + 1;
                Err(vec![GlProgramError {
                    file: file_name.to_owned(),
                    line,
                    column: 1,
                    message: tr!("check-buffer-the-file-is-not-utf-8").to_owned(),
                    help: tr!("check-gl-hand-in-the-gl-program-as").to_owned(),
                }])
            }
        }
    }

    /// A line of the text, from 1, without leading and trailing spaces.
    pub fn quoted(&self, line: u32) -> Option<&str> {
        self.lines.get((line as usize).checked_sub(1)?).map(|line| line.trim())
    }
}

/// A list that is being read.
struct List {
    line: u32,
    name: String,
    whole: bool,
    floats: Vec<f32>,
    indices: Vec<u32>,
    too_long: bool,
}

/// Reads all lines.
fn read(text: &str, file: &str) -> Result<Vec<Step>, Vec<GlProgramError>> {
    let mut steps: Vec<Step> = Vec::new();
    let mut names: HashMap<String, Named> = HashMap::new();
    let mut errors: Vec<GlProgramError> = Vec::new();
    let mut list: Option<List> = None;
    let mut last = 1;
    for (line, content) in (1_u32..).zip(text.lines()) {
        last = line;
        if errors.len() >= MOST_ERRORS {
            break;
        }
        let code = content.split('#').next().unwrap_or_default();
        let words = split(code);
        let Some(&first) = words.first() else { continue };
        let mut report = |error: LineError| {
            let LineError { column, message, help } = error;
            errors.push(GlProgramError { file: file.to_owned(), line, column, message, help });
        };
        if let Some(mut open) = list.take() {
            if first.text == "end" && words.len() == 1 {
                let (name, line) = (open.name.clone(), open.line);
                if open.too_long {
                    // The error was already reported.
                } else if open.whole {
                    steps.push(Step { line, call: GlCall::Indices { name: open.name, numbers: open.indices } });
                } else {
                    steps.push(Step { line, call: GlCall::Data { name: open.name, numbers: open.floats } });
                }
                names.insert(name, Named::Data);
                continue;
            }
            // A missing `end` would make every later line wrong; it is reported at the first one.
            if WORDS.contains(&first.text) || words.get(1).is_some_and(|word| word.text == "=") {
                report(LineError::at(
                    first,
                    tr!("check-gl-call-within-list", name = open.name, line = open.line),
                    tr!("check-gl-write-a-line-with-end-after"),
                ));
                names.insert(open.name, Named::Data);
            } else {
                if let Err(error) = open.take(&words) {
                    report(error);
                }
                list = Some(open);
                continue;
            }
        }
        if let "data" | "indices" = first.text {
            match begin_list(&words, line, &names) {
                Ok(begun) => list = Some(begun),
                Err(error) => report(error),
            }
            continue;
        }
        if steps.len() >= MOST_CALLS {
            report(LineError::at(
                first,
                tr!("check-gl-there-are-more-than-calls", most = MOST_CALLS),
                tr!("check-gl-leave-some-out"),
            ));
            break;
        }
        match signature::call(&words, &names) {
            Ok((call, returned)) => {
                if let Some((name, named)) = returned {
                    names.insert(name, named);
                }
                steps.push(Step { line, call });
            }
            Err(error) => {
                // The name is defined all the same, so that one error does not cause others.
                if let [name, equals, ..] = words.as_slice()
                    && equals.text == "="
                    && is_name(name.text)
                {
                    let image = words.get(2).is_some_and(|word| word.text == "load_image");
                    names.insert(name.text.to_owned(), if image { Named::Image } else { Named::Number });
                }
                report(error);
            }
        }
    }
    let mut at_end = |message: String, help: &str| {
        errors.push(GlProgramError { file: file.to_owned(), line: last, column: 1, message, help: help.to_owned() });
    };
    if let Some(open) = list {
        at_end(
            tr!("check-gl-list-without-end", name = open.name, line = open.line),
            tr!("check-gl-write-a-line-with-end-after"),
        );
    } else if steps.is_empty() {
        at_end(tr!("check-gl-the-program-has-no-calls").to_owned(), tr!("check-gl-each-line-has-a-call-for"));
    }
    errors.truncate(MOST_ERRORS);
    if errors.is_empty() { Ok(steps) } else { Err(errors) }
}

/// The words of a line, with their columns.
fn split(code: &str) -> Vec<Word<'_>> {
    let mut words = Vec::new();
    let mut start = None;
    let mut first_column = 1;
    for (column, (at, c)) in (1_u32..).zip(code.char_indices()) {
        match (c.is_whitespace(), start) {
            (false, None) => {
                start = Some(at);
                first_column = column;
            }
            (true, Some(from)) => {
                words.push(Word { text: &code[from..at], column: first_column });
                start = None;
            }
            _ => {}
        }
    }
    if let Some(from) = start {
        words.push(Word { text: &code[from..], column: first_column });
    }
    words
}

fn begin_list(words: &[Word<'_>], line: u32, names: &HashMap<String, Named>) -> Result<List, LineError> {
    let first = words[0];
    let [_, name] = words else {
        return Err(LineError::at(
            first,
            tr!("check-gl-expects-one-name-and-the-numbers", text = first.text),
            tr!("check-gl-for-example-corners", text = first.text),
        ));
    };
    if !is_name(name.text) || WORDS.contains(&name.text) {
        return Err(LineError::at(
            *name,
            tr!("check-gl-cannot-be-a-name", text = shown(name.text)),
            tr!("check-gl-choose-a-name-that-is-not"),
        ));
    }
    if names.contains_key(name.text) {
        return Err(LineError::at(
            *name,
            tr!("check-gl-already-exists", text = shown(name.text)),
            tr!("check-gl-choose-another-name"),
        ));
    }
    let (name, whole) = (name.text.to_owned(), first.text == "indices");
    Ok(List { line, name, whole, floats: Vec::new(), indices: Vec::new(), too_long: false })
}

impl List {
    fn take(&mut self, words: &[Word<'_>]) -> Result<(), LineError> {
        if self.too_long {
            return Ok(());
        }
        for word in words {
            // Numbers may be copied from C++: `0.5f,`.
            let bare = word.text.trim_end_matches(',');
            if self.whole {
                let number = bare.parse().map_err(|_| {
                    let help = tr!("check-gl-write-integers-from-0");
                    LineError::at(*word, tr!("check-gl-is-not-an-index", text = shown(word.text)), help)
                })?;
                self.indices.push(number);
            } else {
                let bare = if bare.starts_with("0x") { bare } else { bare.trim_end_matches(['f', 'F']) };
                let number = bare.parse().ok().filter(|number: &f32| number.is_finite());
                let Some(number) = number else {
                    let help = tr!("check-gl-write-numbers-such-as-0-5");
                    return Err(LineError::at(*word, tr!("check-gl-is-not-a-number", text = shown(word.text)), help));
                };
                self.floats.push(number);
            }
            if (self.floats.len() + self.indices.len()) * 4 > MOST_DATA_BYTES {
                self.too_long = true;
                let message =
                    tr!("check-gl-the-list-has-more-than-numbers", name = self.name, most = MOST_DATA_BYTES / 4);
                return Err(LineError::at(*word, message, tr!("check-gl-make-it-shorter-a-buffer-may")));
            }
        }
        Ok(())
    }
}
