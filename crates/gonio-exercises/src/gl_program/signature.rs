//! The parameters of each call, word by word.

use gonio_check::words::nearest;
use gonio_language::tr;
use gonio_render::gl_program::{
    CONSTANTS, Constant, GlCall, IntArgument, ObjectKind, Pointer, Selector, UniformArgument, constant,
};
use std::collections::HashMap;

/// The kind of a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Named {
    /// A list of numbers.
    Data,
    /// An image.
    Image,
    /// A number that `gen_...` or `create_program` returned.
    Number,
}

impl Named {
    /// The kind in words.
    pub fn words(self) -> &'static str {
        match self {
            Named::Data => tr!("check-gl-a-list-of-numbers"),
            Named::Image => tr!("check-gl-an-image"),
            Named::Number => tr!("check-gl-a-number"),
        }
    }
}

/// A word and its place.
#[derive(Clone, Copy, Debug)]
pub struct Word<'a> {
    /// The word.
    pub text: &'a str,
    /// Column, from 1.
    pub column: u32,
}

/// The reason why a line cannot be read.
#[derive(Debug)]
pub struct LineError {
    /// Column, from 1.
    pub column: u32,
    /// A sentence without its full stop.
    pub message: String,
    /// How to fix it; may be empty.
    pub help: String,
}

impl LineError {
    /// An error at a word.
    pub fn at(word: Word<'_>, message: impl Into<String>, help: impl Into<String>) -> Self {
        LineError { column: word.column, message: message.into(), help: help.into() }
    }
}

/// Maximum number of characters of a word that messages repeat.
const LONGEST: usize = 40;

/// A word as messages quote it.
pub fn shown(word: &str) -> String {
    let short: String = word.chars().take(LONGEST).collect();
    let safe: String = short.chars().map(|c| if c.is_control() { '?' } else { c }).collect();
    if word.chars().count() > LONGEST { format!("{safe}...") } else { safe }
}

/// Whether a word can be a name.
pub fn is_name(word: &str) -> bool {
    let mut letters = word.chars();
    let first = letters.next().is_some_and(|c| c.is_ascii_alphabetic() || c == '_');
    first && word.len() <= 64 && letters.all(|c| c.is_ascii_alphanumeric() || c == '_')
}

/// Calls and their parameters.
const SIGNATURES: &[(&str, &[&str])] = &[
    ("load_image", &["FILE"]),
    ("create_program", &["VERT", "FRAG"]),
    ("gen_texture", &[]),
    ("gen_buffer", &[]),
    ("gen_vertex_array", &[]),
    ("delete_texture", &["TEXTURE"]),
    ("delete_buffer", &["BUFFER"]),
    ("delete_vertex_array", &["ARRAY"]),
    ("bind_vertex_array", &["ARRAY"]),
    ("bind_buffer", &["TARGET", "BUFFER"]),
    ("buffer_data", &["TARGET", "DATA", "USAGE"]),
    ("vertex_attrib_pointer", &["ATTRIBUTE", "SIZE", "TYPE", "NORMALIZED", "STRIDE", "OFFSET"]),
    ("enable_vertex_attrib_array", &["ATTRIBUTE"]),
    ("disable_vertex_attrib_array", &["ATTRIBUTE"]),
    ("active_texture", &["UNIT"]),
    ("bind_texture", &["TARGET", "TEXTURE"]),
    ("tex_image_2d", &["TARGET", "LEVEL", "FORMAT", "IMAGE"]),
    ("tex_parameter", &["TARGET", "PARAMETER", "VALUE"]),
    ("generate_mipmap", &["TARGET"]),
    ("use_program", &["PROGRAM"]),
    ("uniform_1i", &["UNIFORM", "NUMBER"]),
    ("uniform_1f", &["UNIFORM", "X"]),
    ("uniform_2f", &["UNIFORM", "X", "Y"]),
    ("uniform_3f", &["UNIFORM", "X", "Y", "Z"]),
    ("uniform_4f", &["UNIFORM", "X", "Y", "Z", "W"]),
    ("viewport", &["X", "Y", "WIDTH", "HEIGHT"]),
    ("enable", &["WHAT"]),
    ("disable", &["WHAT"]),
    ("clear_color", &["R", "G", "B", "A"]),
    ("clear", &["WHAT"]),
    ("draw_arrays", &["MODE", "FIRST", "COUNT"]),
    ("draw_elements", &["MODE", "COUNT", "TYPE", "OFFSET"]),
];

/// All words that a line may begin with, except names.
pub const WORDS: &[&str] = &{
    let mut words = [""; SIGNATURES.len() + 2];
    let mut i = 0;
    while i < SIGNATURES.len() {
        words[i] = SIGNATURES[i].0;
        i += 1;
    }
    words[i] = "data";
    words[i + 1] = "indices";
    words
};

/// The names that are known in a line.
type Names = HashMap<String, Named>;
/// The call of a line, and the name that it defines.
type Read = (GlCall, Option<(String, Named)>);

/// Reads a line that does not begin a list.
pub fn call(words: &[Word<'_>], names: &Names) -> Result<Read, LineError> {
    let (returned, rest) = match words {
        [name, equals, rest @ ..] if equals.text == "=" => (Some(*name), rest),
        [name, ..] if name.text.contains('=') => {
            return Err(LineError::at(*name, tr!("check-gl-expected-spaces-around"), tr!("check-gl-write-name-call")));
        }
        _ => (None, words),
    };
    let Some((&word, given)) = rest.split_first() else {
        let end = words[words.len() - 1];
        return Err(LineError::at(
            end,
            tr!("check-gl-expected-a-call-after"),
            tr!("check-gl-write-name-gen-texture-or-the"),
        ));
    };
    let Some((_, expected)) = SIGNATURES.iter().find(|(known, _)| *known == word.text) else {
        return Err(no_call(word));
    };
    // `clear` takes any number of arguments.
    let fits = if word.text == "clear" { !given.is_empty() } else { given.len() == expected.len() };
    if !fits {
        return Err(LineError::at(
            given.get(expected.len()).copied().unwrap_or(word),
            tr!("check-gl-expects-argument-but-got", text = word.text, count = expected.len(), given = given.len()),
            tr!("check-gl-write", text = [&[word.text], *expected].concat().join(" ")),
        ));
    }
    let arguments = Arguments { given, names };
    let name = match returned {
        None => String::new(),
        Some(name) if !is_name(name.text) || WORDS.contains(&name.text) || name.text == "end" => {
            return Err(LineError::at(
                name,
                tr!("check-gl-cannot-be-a-name", text = shown(name.text)),
                tr!("check-gl-choose-a-name-that-is-not"),
            ));
        }
        Some(name) if constant(name.text).is_some() => {
            return Err(LineError::at(
                name,
                tr!("check-gl-is-a-constant-of-opengl", text = name.text),
                tr!("check-gl-take-another-name"),
            ));
        }
        Some(name) => match names.get(name.text) {
            Some(known @ (Named::Data | Named::Image)) => {
                let message = tr!("check-gl-is-already", text = name.text, words = known.words());
                return Err(LineError::at(name, message, tr!("check-gl-take-another-name")));
            }
            _ => name.text.to_owned(),
        },
    };
    let call = arguments.call(word.text, name.clone())?;
    let gives = match &call {
        GlCall::LoadImage { .. } => Some(Named::Image),
        GlCall::CreateProgram { .. } | GlCall::Generate { .. } => Some(Named::Number),
        _ => None,
    };
    match (gives, returned) {
        (Some(named), Some(_)) => Ok((call, Some((name, named)))),
        (Some(_), None) => {
            let help = tr!("check-gl-write-name", text = word.text);
            Err(LineError::at(word, tr!("check-gl-the-result-of-is-not-stored", text = word.text), help))
        }
        (None, Some(name)) => {
            let message =
                tr!("check-gl-returns-nothing-that-can-be-stored", text = word.text, text2 = shown(name.text));
            Err(LineError::at(name, message, tr!("check-gl-write-without-a-name", text = word.text)))
        }
        (None, None) => Ok((call, None)),
    }
}

/// The words after a call's name, in the expected number.
struct Arguments<'a> {
    given: &'a [Word<'a>],
    names: &'a Names,
}

impl Arguments<'_> {
    fn call(&self, word: &str, name: String) -> Result<GlCall, LineError> {
        Ok(match word {
            "load_image" => GlCall::LoadImage { name, file: self.file(0)? },
            "create_program" => GlCall::CreateProgram { name, vertex: self.file(0)?, fragment: self.file(1)? },
            "gen_texture" => GlCall::Generate { name, kind: ObjectKind::Texture },
            "gen_buffer" => GlCall::Generate { name, kind: ObjectKind::Buffer },
            "gen_vertex_array" => GlCall::Generate { name, kind: ObjectKind::VertexArray },
            "delete_texture" => GlCall::Delete { kind: ObjectKind::Texture, object: self.number(0)? },
            "delete_buffer" => GlCall::Delete { kind: ObjectKind::Buffer, object: self.number(0)? },
            "delete_vertex_array" => GlCall::Delete { kind: ObjectKind::VertexArray, object: self.number(0)? },
            "bind_vertex_array" => GlCall::BindVertexArray(self.number(0)?),
            "bind_buffer" => GlCall::BindBuffer { target: self.constant(0)?, buffer: self.number(1)? },
            "buffer_data" => {
                let data = self.named(1, Named::Data, "data NAME ... end")?;
                GlCall::BufferData { target: self.constant(0)?, data, usage: self.constant(2)? }
            }
            "vertex_attrib_pointer" => GlCall::VertexAttribPointer(Pointer {
                attribute: self.variable(0)?,
                size: self.whole(1)?,
                kind: self.constant(2)?,
                normalized: self.truth(3)?,
                stride: self.whole(4)?,
                offset: self.whole(5)?,
            }),
            "enable_vertex_attrib_array" => GlCall::SwitchAttribute { attribute: self.variable(0)?, on: true },
            "disable_vertex_attrib_array" => GlCall::SwitchAttribute { attribute: self.variable(0)?, on: false },
            "active_texture" => GlCall::ActiveTexture(self.selector(0)?),
            "bind_texture" => GlCall::BindTexture { target: self.constant(0)?, texture: self.number(1)? },
            "tex_image_2d" => {
                let image = self.named(3, Named::Image, "NAME = load_image FILE")?;
                let (target, level) = (self.constant(0)?, self.whole(1)?);
                GlCall::TexImage2d { target, level, format: self.constant(2)?, image }
            }
            "tex_parameter" => {
                let (target, parameter) = (self.constant(0)?, self.constant(1)?);
                GlCall::TexParameter { target, parameter, value: self.selector(2)? }
            }
            "generate_mipmap" => GlCall::GenerateMipmap { target: self.constant(0)? },
            "use_program" => GlCall::UseProgram(self.number(0)?),
            "uniform_1i" => {
                GlCall::Uniform { uniform: self.variable(0)?, given: UniformArgument::Whole(self.number(1)?) }
            }
            "uniform_1f" | "uniform_2f" | "uniform_3f" | "uniform_4f" => {
                let numbers = (1..self.given.len()).map(|at| self.float(at)).collect::<Result<_, _>>()?;
                GlCall::Uniform { uniform: self.variable(0)?, given: UniformArgument::Floats(numbers) }
            }
            "viewport" => GlCall::Viewport([self.whole(0)?, self.whole(1)?, self.whole(2)?, self.whole(3)?]),
            "enable" => GlCall::Switch { what: self.constant(0)?, on: true },
            "disable" => GlCall::Switch { what: self.constant(0)?, on: false },
            "clear_color" => GlCall::ClearColor([self.float(0)?, self.float(1)?, self.float(2)?, self.float(3)?]),
            "clear" => GlCall::Clear(self.bits()?),
            "draw_arrays" => {
                GlCall::DrawArrays { mode: self.constant(0)?, first: self.whole(1)?, count: self.whole(2)? }
            }
            "draw_elements" => {
                let (mode, count) = (self.constant(0)?, self.whole(1)?);
                GlCall::DrawElements { mode, count, kind: self.constant(2)?, offset: self.whole(3)? }
            }
            _ => {
                return Err(LineError {
                    column: 1,
                    message: tr!("check-gl-unknown-word", word = word),
                    help: String::new(),
                });
            }
        })
    }

    fn word(&self, at: usize) -> Result<Word<'_>, LineError> {
        let missing =
            || LineError { column: 1, message: tr!("check-gl-an-argument-is-missing").to_owned(), help: String::new() };
        self.given.get(at).copied().ok_or_else(missing)
    }

    /// A file name. It is only looked up among the given files, and never opened as a path.
    fn file(&self, at: usize) -> Result<String, LineError> {
        let word = self.word(at)?;
        Ok(word.text.trim_matches('"').to_owned())
    }

    /// An attribute's or a uniform's name.
    fn variable(&self, at: usize) -> Result<String, LineError> {
        let word = self.word(at)?;
        let bare = word.text.trim_matches('"');
        // GLSL names, with members and elements.
        let fits = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '.' | '[' | ']');
        if bare.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
            && bare.len() <= 128
            && bare.chars().all(fits)
        {
            return Ok(bare.to_owned());
        }
        let help = tr!("check-gl-write-the-name-that-it-has");
        Err(LineError::at(word, tr!("check-gl-cannot-be-the-name-of-a", text = shown(word.text)), help))
    }

    fn whole(&self, at: usize) -> Result<i32, LineError> {
        let word = self.word(at)?;
        word.text.parse().map_err(|_| {
            let big = word.text.parse::<i128>().is_ok();
            let message = match big {
                true => tr!("check-gl-is-too-large", text = shown(word.text)),
                false => tr!("check-gl-is-not-an-integer", text = shown(word.text)),
            };
            LineError::at(word, message, tr!("check-gl-write-an-integer-such-as-32"))
        })
    }

    fn float(&self, at: usize) -> Result<f32, LineError> {
        let word = self.word(at)?;
        let number = word.text.trim_end_matches('f').parse().ok().filter(|number: &f32| number.is_finite());
        number.ok_or_else(|| {
            LineError::at(
                word,
                tr!("check-gl-is-not-a-number", text = shown(word.text)),
                tr!("check-gl-write-a-number-such-as-0"),
            )
        })
    }

    fn truth(&self, at: usize) -> Result<bool, LineError> {
        let word = self.word(at)?;
        match word.text {
            "TRUE" => Ok(true),
            "FALSE" => Ok(false),
            other => Err(LineError::at(
                word,
                tr!("check-gl-is-neither-true-nor-false", other = shown(other)),
                tr!("check-gl-write-false"),
            )),
        }
    }

    fn constant(&self, at: usize) -> Result<Constant, LineError> {
        let word = self.word(at)?;
        constant(word.text).ok_or_else(|| no_constant(word))
    }

    /// A number, or a name that stands for one.
    fn number(&self, at: usize) -> Result<IntArgument, LineError> {
        let word = self.word(at)?;
        match self.names.get(word.text) {
            Some(Named::Number) => return Ok(IntArgument::Variable(word.text.to_owned())),
            Some(other) => {
                let message = tr!("check-gl-named-is-not-a-number", text = word.text, words = other.words());
                return Err(LineError::at(word, message, tr!("check-gl-use-a-name-that-stores-the")));
            }
            None => {}
        }
        if is_name(word.text) {
            let numbers = self.names.iter().filter(|(_, named)| **named == Named::Number);
            let mut known: Vec<&str> = numbers.map(|(name, _)| name.as_str()).collect();
            known.sort_unstable();
            let help = match nearest(word.text, known) {
                Some(known) => tr!("check-gl-did-you-mean", known = known),
                None => tr!("check-gl-a-line-must-come-before-this", text = shown(word.text)),
            };
            return Err(LineError::at(word, tr!("check-gl-is-not-defined-yet", text = shown(word.text)), help));
        }
        Ok(IntArgument::Literal(self.whole(at)?))
    }

    /// A constant, or a number in its place.
    fn selector(&self, at: usize) -> Result<Selector, LineError> {
        let word = self.word(at)?;
        if let Some(constant) = constant(word.text) {
            return Ok(Selector::Constant(constant));
        }
        if word.text.starts_with(|c: char| c.is_ascii_digit() || c == '-') || self.names.contains_key(word.text) {
            return Ok(Selector::Number(self.number(at)?));
        }
        Err(no_constant(word))
    }

    fn named(&self, at: usize, expected: Named, how: &str) -> Result<String, LineError> {
        let word = self.word(at)?;
        match self.names.get(word.text) {
            Some(named) if *named == expected => Ok(word.text.to_owned()),
            Some(named) => {
                let message = tr!(
                    "check-gl-named-is-of-another-kind",
                    text = word.text,
                    words = named.words(),
                    words2 = expected.words()
                );
                Err(LineError::at(word, message, tr!("check-gl-create-one-with", how = how)))
            }
            None => {
                let mut known: Vec<&str> =
                    self.names.iter().filter(|n| *n.1 == expected).map(|n| n.0.as_str()).collect();
                known.sort_unstable();
                let help = match nearest(word.text, known) {
                    Some(known) => tr!("check-gl-did-you-mean", known = known),
                    None => tr!("check-gl-create-it-first-with", how = how),
                };
                Err(LineError::at(word, tr!("check-gl-is-not-defined-yet", text = shown(word.text)), help))
            }
        }
    }

    /// Bits, separated by spaces or `|`.
    fn bits(&self) -> Result<Vec<Constant>, LineError> {
        let mut bits = Vec::new();
        for word in self.given {
            for part in word.text.split('|').filter(|part| !part.is_empty()) {
                bits.push(constant(part).ok_or_else(|| no_constant(Word { text: part, column: word.column }))?);
            }
        }
        Ok(bits)
    }
}

fn no_constant(word: Word<'_>) -> LineError {
    let bare = word.text.trim_start_matches("GL_").trim_end_matches([',', ')', ';']);
    let help = if bare != word.text && constant(bare).is_some() {
        tr!("check-gl-write-without-gl-commas-and-parentheses", bare = bare)
    } else {
        match nearest(bare, CONSTANTS.iter().map(|constant| constant.name)) {
            Some(known) => tr!("check-gl-did-you-mean", known = known),
            None => tr!("check-gl-write-constants-in-upper-case-without").to_owned(),
        }
    };
    LineError::at(word, tr!("check-gl-unknown-constant", text = shown(word.text)), help)
}

/// The error for a word that is not a call.
fn no_call(word: Word<'_>) -> LineError {
    let text = word.text;
    let bare = text.split('(').next().unwrap_or_default();
    let help = if bare.starts_with("gl") && bare.chars().nth(2).is_some_and(char::is_uppercase) {
        let snake = snake(&bare[2..]);
        match nearest(&snake, WORDS.iter().copied()) {
            Some(known) => tr!("check-gl-write-with-its-arguments-without-parentheses", known = known),
            None => tr!("check-gl-write-calls-without-gl-in-lower").to_owned(),
        }
    } else {
        match nearest(bare, WORDS.iter().copied()) {
            Some(known) => tr!("check-gl-did-you-mean", known = known),
            None => tr!("check-gl-text-md-has-a-table-of").to_owned(),
        }
    };
    LineError::at(word, tr!("check-gl-unknown-call", text = shown(text)), help)
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
