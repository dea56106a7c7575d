//! Reads GL programs: a call to a line, words between blanks.

use super::program::{GlProgramError, MOST_CALLS, MOST_DATA_BYTES, MOST_ERRORS};
use super::signature::{self, WORDS};
use gonio_check::nearest::nearest;
use gonio_render::gl_program::{Call, Step};
use std::collections::HashMap;

/// What a name stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Named {
    /// A list of numbers.
    Data,
    /// An image.
    Image,
    /// A number: what `gen_...` or `create_program` returned.
    Number,
}

impl Named {
    /// For people.
    pub fn words(self) -> &'static str {
        match self {
            Named::Data => "a list of numbers",
            Named::Image => "an image",
            Named::Number => "a number",
        }
    }
}

/// A word and where it stands.
#[derive(Clone, Copy, Debug)]
pub struct Word<'a> {
    /// The word.
    pub text: &'a str,
    /// From 1.
    pub column: u32,
}

/// Why a line cannot be read.
#[derive(Debug)]
pub struct Problem {
    /// From 1.
    pub column: u32,
    /// A sentence without its end.
    pub message: String,
    /// The remedy; may be empty.
    pub help: String,
}

impl Problem {
    /// At a word.
    pub fn at(word: Word<'_>, message: impl Into<String>, help: impl Into<String>) -> Self {
        Problem { column: word.column, message: message.into(), help: help.into() }
    }
}

/// Longest words that messages repeat.
const LONGEST: usize = 40;

/// A word as messages repeat it.
pub fn shown(word: &str) -> String {
    let short: String = word.chars().take(LONGEST).collect();
    let safe: String = short.chars().map(|c| if c.is_control() { '?' } else { c }).collect();
    if word.chars().count() > LONGEST { format!("{safe}...") } else { safe }
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
pub fn read(text: &str, file: &str) -> Result<Vec<Step>, Vec<GlProgramError>> {
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
        let mut problem = |problem: Problem| {
            let Problem { column, message, help } = problem;
            errors.push(GlProgramError { file: file.to_owned(), line, column, message, help });
        };
        if let Some(mut open) = list.take() {
            if first.text == "end" && words.len() == 1 {
                let (name, line) = (open.name.clone(), open.line);
                if open.too_long {
                    // It was told where it happened.
                } else if open.whole {
                    steps.push(Step { line, call: Call::Indices { name: open.name, numbers: open.indices } });
                } else {
                    steps.push(Step { line, call: Call::Data { name: open.name, numbers: open.floats } });
                }
                names.insert(name, Named::Data);
                continue;
            }
            // A forgotten `end` would make every later line wrong; the first one tells it.
            if WORDS.contains(&first.text) || words.get(1).is_some_and(|word| word.text == "=") {
                problem(Problem::at(
                    first,
                    format!("the list `{}`, begun in line {}, has no end before this call", open.name, open.line),
                    "write a line with `end` after its last number",
                ));
                names.insert(open.name, Named::Data);
            } else {
                if let Err(why) = open.take(&words) {
                    problem(why);
                }
                list = Some(open);
                continue;
            }
        }
        if let "data" | "indices" = first.text {
            match begin_list(&words, line, &names) {
                Ok(begun) => list = Some(begun),
                Err(why) => problem(why),
            }
            continue;
        }
        if steps.len() >= MOST_CALLS {
            problem(Problem::at(first, format!("there are more than {MOST_CALLS} calls"), "leave some out"));
            break;
        }
        match signature::call(&words, &names) {
            Ok((call, returned)) => {
                if let Some((name, named)) = returned {
                    names.insert(name, named);
                }
                steps.push(Step { line, call });
            }
            Err(why) => {
                // What it would have returned is known all the same, so that one error is not ten.
                if let [name, equals, ..] = words.as_slice()
                    && equals.text == "="
                    && is_name(name.text)
                {
                    let image = words.get(2).is_some_and(|word| word.text == "load_image");
                    names.insert(name.text.to_owned(), if image { Named::Image } else { Named::Number });
                }
                problem(why);
            }
        }
    }
    let mut at_end = |message: String, help: &str| {
        errors.push(GlProgramError { file: file.to_owned(), line: last, column: 1, message, help: help.to_owned() });
    };
    if let Some(open) = list {
        at_end(
            format!("the list `{}`, begun in line {}, has no end", open.name, open.line),
            "write a line with `end` after its last number",
        );
    } else if steps.is_empty() {
        at_end("the program has no calls".to_owned(), "each line has a call, for example `gen_texture`");
    }
    errors.truncate(MOST_ERRORS);
    if errors.is_empty() { Ok(steps) } else { Err(errors) }
}

/// Words between blanks, with their columns.
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

/// Whether a word can name something.
pub fn is_name(word: &str) -> bool {
    let mut letters = word.chars();
    let first = letters.next().is_some_and(|c| c.is_ascii_alphabetic() || c == '_');
    first && word.len() <= 64 && letters.all(|c| c.is_ascii_alphanumeric() || c == '_')
}

fn begin_list(words: &[Word<'_>], line: u32, names: &HashMap<String, Named>) -> Result<List, Problem> {
    let first = words[0];
    let [_, name] = words else {
        return Err(Problem::at(
            first,
            format!("`{}` wants one name, and the numbers in the lines below", first.text),
            format!("for example `{} corners`", first.text),
        ));
    };
    if !is_name(name.text) || WORDS.contains(&name.text) {
        return Err(Problem::at(*name, format!("`{}` cannot be a name", shown(name.text)), "take a word of letters"));
    }
    if names.contains_key(name.text) {
        return Err(Problem::at(*name, format!("there is a `{}` already", shown(name.text)), "take another name"));
    }
    let (name, whole) = (name.text.to_owned(), first.text == "indices");
    Ok(List { line, name, whole, floats: Vec::new(), indices: Vec::new(), too_long: false })
}

impl List {
    fn take(&mut self, words: &[Word<'_>]) -> Result<(), Problem> {
        if self.too_long {
            return Ok(());
        }
        for word in words {
            // As it is copied from C++: `0.5f,`.
            let bare = word.text.trim_end_matches(',');
            if self.whole {
                let number = bare.parse().map_err(|_| {
                    let help = "write whole numbers from 0 on";
                    Problem::at(*word, format!("`{}` is not an index", shown(word.text)), help)
                })?;
                self.indices.push(number);
            } else {
                let bare = if bare.starts_with("0x") { bare } else { bare.trim_end_matches(['f', 'F']) };
                let number = bare.parse().ok().filter(|number: &f32| number.is_finite());
                let Some(number) = number else {
                    let help = "write numbers such as 0.5, or `end` after the last one";
                    return Err(Problem::at(*word, format!("`{}` is not a number", shown(word.text)), help));
                };
                self.floats.push(number);
            }
            if (self.floats.len() + self.indices.len()) * 4 > MOST_DATA_BYTES {
                self.too_long = true;
                let message = format!("the list `{}` has more than {} numbers", self.name, MOST_DATA_BYTES / 4);
                return Err(Problem::at(*word, message, "make it shorter: a buffer has at most 1 MB"));
            }
        }
        Ok(())
    }
}

/// What to say of a word that is no call.
pub fn no_call(word: Word<'_>) -> Problem {
    let text = word.text;
    let bare = text.split('(').next().unwrap_or_default();
    let help = if bare.starts_with("gl") && bare.chars().nth(2).is_some_and(char::is_uppercase) {
        let snake = snake(&bare[2..]);
        match nearest(&snake, WORDS.iter().copied()) {
            Some(known) => format!("write `{known}`, and its arguments without brackets and commas"),
            None => "write calls without `gl`, in small letters, words joined by `_`".to_owned(),
        }
    } else {
        match nearest(bare, WORDS.iter().copied()) {
            Some(known) => format!("did you mean `{known}`?"),
            None => "text.md has a table of the calls".to_owned(),
        }
    };
    Problem::at(word, format!("there is no call `{}`", shown(text)), help)
}

/// `BindTexture` as `bind_texture`.
fn snake(word: &str) -> String {
    let mut snake = String::new();
    for c in word.chars().take(LONGEST) {
        if c.is_ascii_uppercase() && !snake.is_empty() {
            snake.push('_');
        }
        snake.push(c.to_ascii_lowercase());
    }
    snake
}
