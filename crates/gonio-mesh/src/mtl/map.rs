//! Texture statements: options, followed by a file name that may contain spaces.

use crate::diagnostic::Reports;
use crate::text::{Cursor, quote};
use crate::{Channel, Severity, TextureMap, Wrap};

/// The use of a texture.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum MapUse {
    /// A colour, encoded as sRGB.
    Color,
    /// A scalar.
    Scalar,
    /// Heights or normals.
    Bump,
    /// A reflection map, `refl`; `-type` sets its projection.
    Surroundings,
}

/// The values of an option.
enum Values {
    /// One to three numbers.
    UpToThree,
    /// A fixed count of numbers.
    Numbers(usize),
    /// One word.
    Word,
}

/// Options of the format and its extensions.
const OPTIONS: [(&str, Values); 15] = [
    ("-s", Values::UpToThree),
    ("-o", Values::UpToThree),
    ("-t", Values::UpToThree),
    ("-mm", Values::Numbers(2)),
    ("-bm", Values::Numbers(1)),
    ("-boost", Values::Numbers(1)),
    ("-clamp", Values::Word),
    ("-blendu", Values::Word),
    ("-blendv", Values::Word),
    ("-cc", Values::Word),
    ("-imfchan", Values::Word),
    ("-texres", Values::Word),
    ("-type", Values::Word),
    ("-colorspace", Values::Word),
    ("-lod", Values::Word),
];

/// Projections of `refl -type`.
const PROJECTIONS: [&str; 7] =
    ["sphere", "cube_top", "cube_bottom", "cube_front", "cube_back", "cube_left", "cube_right"];

/// Options that are recognised but not supported, to be reported once each.
#[derive(Default)]
pub(super) struct UnsupportedOptions {
    /// Option, number of uses, and line and column of the first one.
    options: Vec<(&'static str, u64, u64, Option<u64>)>,
}

impl UnsupportedOptions {
    fn add(&mut self, option: &'static str, line: u64, column: Option<u64>) {
        match self.options.iter_mut().find(|known| known.0 == option) {
            Some(known) => known.1 += 1,
            None => self.options.push((option, 1, line, column)),
        }
    }

    pub(super) fn report(self, reports: &mut Reports) {
        for (option, count, line, column) in self.options {
            let times = if count == 1 { "once".to_owned() } else { format!("{count} times") };
            let message = format!("the texture option {option} ({times}) is not supported");
            reports.push(line, crate::Diagnostic::note(message).at(line, column));
        }
    }
}

/// The contents of a texture statement: the texture, and the word of `-type`.
pub(super) struct Statement {
    pub(super) texture: TextureMap,
    pub(super) projection: Option<&'static str>,
}

/// Reads the rest of a texture statement. `None` if it has no file name.
pub(super) fn read(
    cursor: &mut Cursor<'_>,
    keyword: &'static str,
    purpose: MapUse,
    unsupported: &mut UnsupportedOptions,
    reports: &mut Reports,
) -> Option<Statement> {
    let line = cursor.line();
    let texture = TextureMap { line: Some(line), ..TextureMap::new("") };
    let mut reader =
        Reader { statement: Statement { texture, projection: None }, keyword, purpose, unsupported, reports };
    let mut name = reader.options(cursor, Some(line));
    // Some programs write the options last (`bump.jpg -bm 1.5`).
    while let Some(at) = trailing_option(&name) {
        // Otherwise ` -s` belongs to the name.
        if !is_only_options(&name[at..]) {
            break;
        }
        reader.options(&mut Cursor::new(&name.as_bytes()[at..]), None);
        name.truncate(name[..at].trim_end().len());
    }
    let unquoted = name.strip_prefix('"').and_then(|n| n.strip_suffix('"')).unwrap_or(&name);
    if unquoted.is_empty() {
        let column = Some(cursor.column());
        reader.reports.add("textures without a file name", Severity::Warning, line, column, || {
            format!("{keyword} names no file: it is ignored")
        });
        return None;
    }
    let mut statement = reader.statement;
    statement.texture.path = unquoted.to_owned();
    Some(statement)
}

/// Returns the start of the last ` -option` in a name that is followed by options.
fn trailing_option(text: &str) -> Option<usize> {
    let (at, _) = text.rmatch_indices([' ', '\t']).find(|(at, _)| {
        let rest = &text[at + 1..];
        rest.starts_with('-') && rest.split_whitespace().next().is_some_and(|word| option(word.as_bytes()).is_some())
    })?;
    Some(at + 1)
}

/// Whether `text`, which begins with an option, consists only of that option and its values.
fn is_only_options(text: &str) -> bool {
    let mut words = text.split_whitespace();
    let most = match words.next().and_then(|word| option(word.as_bytes())) {
        Some((_, Values::Word)) => return words.count() == 1,
        Some((_, Values::Numbers(n))) => *n,
        Some((_, Values::UpToThree)) => 3,
        None => return false,
    };
    let mut count = 0;
    words.all(|word| {
        count += 1;
        count <= most && word.parse::<f32>().is_ok_and(f32::is_finite)
    })
}

fn option(word: &[u8]) -> Option<&'static (&'static str, Values)> {
    OPTIONS.iter().find(|(name, _)| name.as_bytes().eq_ignore_ascii_case(word))
}

struct Reader<'a> {
    statement: Statement,
    keyword: &'static str,
    purpose: MapUse,
    unsupported: &'a mut UnsupportedOptions,
    reports: &'a mut Reports,
}

/// The line of an option, and its column if known.
#[derive(Clone, Copy)]
struct OptionPlace {
    option: &'static str,
    line: u64,
    column: Option<u64>,
}

impl Reader<'_> {
    /// Reads leading options and returns the text after them. `line` is `None` if the cursor is in a copy, whose lines
    /// and columns are not those of the file.
    fn options(&mut self, cursor: &mut Cursor<'_>, line: Option<u64>) -> String {
        while cursor.next_word() && cursor.peek() == Some(b'-') {
            let column = line.map(|_| cursor.column());
            let own_line = line.map_or(self.statement.texture.line.unwrap_or(0), |_| cursor.line());
            let Some((name, values)) = option(cursor.offending_word()) else {
                let word = cursor.offending_word();
                // A file may be called `-1.png`.
                let is_name = word.contains(&b'.') || word[1..].iter().all(u8::is_ascii_digit);
                if is_name {
                    break;
                }
                let word = cursor.word();
                if !cursor.next_word() {
                    return crate::text::decode(word);
                }
                let keyword = self.keyword;
                self.reports.add("unknown texture options", Severity::Warning, own_line, column, || {
                    format!("{keyword} has the unknown option {}: it is skipped", quote(word))
                });
                continue;
            };
            cursor.word();
            let at = OptionPlace { option: name, line: own_line, column };
            let mut numbers = [0.0; 3];
            match values {
                Values::UpToThree => self.numbers(cursor, &mut numbers, at),
                Values::Numbers(n) => self.numbers(cursor, &mut numbers[..*n], at),
                Values::Word => {
                    cursor.next_word();
                    let value = String::from_utf8_lossy(cursor.word()).into_owned();
                    self.word(&value, at);
                }
            }
        }
        cursor.name()
    }

    fn numbers(&mut self, cursor: &mut Cursor<'_>, numbers: &mut [f32], at: OptionPlace) {
        let mut count = 0;
        while count < numbers.len() && cursor.next_word() {
            let Ok(value) = cursor.number() else { break };
            numbers[count] = value;
            count += 1;
        }
        let numbers = &numbers[..count];
        let texture = &mut self.statement.texture;
        match (at.option, numbers) {
            (_, []) => {
                let keyword = self.keyword;
                self.reports.add("texture options without a number", Severity::Warning, at.line, at.column, || {
                    format!("{keyword} has {} without a number: it is skipped", at.option)
                });
            }
            // The format's defaults are 1 for a scale and 0 for an offset.
            ("-s", numbers) => texture.scale = [numbers[0], numbers.get(1).copied().unwrap_or(1.0)],
            ("-o", numbers) => texture.offset = [numbers[0], numbers.get(1).copied().unwrap_or(0.0)],
            ("-mm", numbers) => {
                (texture.texel.base, texture.texel.gain) = (numbers[0], numbers.get(1).copied().unwrap_or(1.0));
            }
            ("-bm", numbers) if self.purpose == MapUse::Bump => texture.bump_multiplier = numbers[0],
            ("-bm", [1.0]) => {}
            ("-t" | "-boost", numbers) if numbers.iter().all(|n| *n == 0.0) => {}
            _ => self.unsupported.add(at.option, at.line, at.column),
        }
    }

    fn word(&mut self, value: &str, at: OptionPlace) {
        let is = |word: &str| value.eq_ignore_ascii_case(word);
        let is_colors = self.purpose == MapUse::Color;
        match at.option {
            "-clamp" if is("on") => self.statement.texture.wrap = [Wrap::Clamp; 2],
            "-clamp" if is("off") => self.statement.texture.wrap = [Wrap::Repeat; 2],
            // Blending is filtering, which is always on.
            "-blendu" | "-blendv" if is("on") => {}
            "-cc" if is("off") => {}
            "-clamp" | "-blendu" | "-blendv" | "-cc" if !is("on") && !is("off") => {
                self.bad_word(value, "on or off", at);
            }
            "-imfchan" => match channel(value) {
                Some(Some(_)) if is_colors => self.unsupported.add(at.option, at.line, at.column),
                Some(Some(channel)) => self.statement.texture.texel.channel = Some(channel),
                Some(None) => self.unsupported.add(at.option, at.line, at.column),
                None => self.bad_word(value, "r, g, b, m, l or z", at),
            },
            "-colorspace" if if is_colors { is("sRGB") } else { is("linear") || is("raw") || is("non-color") } => {}
            "-type" if self.purpose == MapUse::Surroundings => {
                let known = PROJECTIONS.into_iter().find(|known| is(known));
                if known.is_none() {
                    self.bad_word(value, "sphere or cube_top, cube_bottom, cube_front and so on", at);
                }
                self.statement.projection = known;
            }
            option => self.unsupported.add(option, at.line, at.column),
        }
    }

    fn bad_word(&mut self, value: &str, expected: &str, at: OptionPlace) {
        let keyword = self.keyword;
        self.reports.add("texture options that are not understood", Severity::Warning, at.line, at.column, || {
            format!("{keyword} has {} {} instead of {expected}: it is skipped", at.option, quote(value.as_bytes()))
        });
    }
}

/// Parses a word of `-imfchan`; an image has no depth channel, `z`.
fn channel(word: &str) -> Option<Option<Channel>> {
    match word.to_ascii_lowercase().as_str() {
        "r" => Some(Some(Channel::Red)),
        "g" => Some(Some(Channel::Green)),
        "b" => Some(Some(Channel::Blue)),
        "m" => Some(Some(Channel::Alpha)),
        "l" => Some(Some(Channel::Luminance)),
        "z" => Some(None),
        _ => None,
    }
}
