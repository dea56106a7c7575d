//! Texture statements: options, then a file name that may have spaces.

use crate::report::Reports;
use crate::text::{Cursor, quote};
use crate::{Severity, TextureMap};

/// What follows an option.
enum Values {
    /// One to three numbers.
    UpToThree,
    /// So many numbers.
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

/// Reads the rest of a texture statement into `map`. `-t`, `-mm`, `-boost`, `-cc`, `-imfchan`, `-texres`, `-type` and
/// the like are stepped over: what they ask for is not done, which is noted where it would show.
pub(super) fn read(
    map: &mut Option<TextureMap>,
    cursor: &mut Cursor<'_>,
    keyword: &'static str,
    reports: &mut Reports,
) {
    let line = cursor.line();
    let text = cursor.name();
    let mut texture = TextureMap { line: Some(line), ..TextureMap::new("") };
    let mut rest = options(&text, &mut texture, keyword, line, reports);
    // Some programs write the options last (`bump.jpg -bm 1.5`).
    let mut name = rest.to_owned();
    while let Some(at) = trailing_option(rest) {
        let after = options(&rest[at..], &mut texture, keyword, line, reports);
        if !after.is_empty() {
            break;
        }
        rest = rest[..at].trim_end();
        name = rest.to_owned();
    }
    let unquoted = name.strip_prefix('"').and_then(|n| n.strip_suffix('"')).unwrap_or(&name);
    if unquoted.is_empty() {
        reports.add("textures without a file name", Severity::Warning, line, None, || {
            format!("{keyword} names no file: it is ignored")
        });
        return;
    }
    texture.path = unquoted.to_owned();
    *map = Some(texture);
}

/// Where the last ` -option` of a name with options behind it starts.
fn trailing_option(text: &str) -> Option<usize> {
    let (at, _) = text.rmatch_indices(" -").find(|(at, _)| {
        let word = text[at + 1..].split_whitespace().next().unwrap_or_default();
        option(word).is_some()
    })?;
    Some(at + 1)
}

fn option(word: &str) -> Option<&'static (&'static str, Values)> {
    OPTIONS.iter().find(|(name, _)| name.eq_ignore_ascii_case(word))
}

/// Steps over leading options, applying those that matter; returns what follows them.
fn options<'a>(
    text: &'a str,
    texture: &mut TextureMap,
    keyword: &'static str,
    line: u64,
    reports: &mut Reports,
) -> &'a str {
    let mut rest = text.trim_start();
    while rest.starts_with('-') {
        let (word, after) = first_word(rest);
        let Some((name, values)) = option(word) else {
            // A file may be called `-1.png`; an option without a file behind it would have no effect anyway.
            if !after.is_empty() && word.parse::<f32>().is_err() && !word.contains('.') {
                reports.add("unknown options of textures", Severity::Warning, line, None, || {
                    format!("{keyword} has the unknown option {}: it is skipped", quote(word.as_bytes()))
                });
                rest = after;
                continue;
            }
            return rest;
        };
        rest = after;
        let mut numbers = [0.0; 3];
        let count = match values {
            Values::UpToThree => take_numbers(&mut rest, &mut numbers),
            Values::Numbers(n) => take_numbers(&mut rest, &mut numbers[..*n]),
            Values::Word => {
                let (value, after) = first_word(rest);
                rest = after;
                apply_word(texture, name, value, keyword, line, reports);
                continue;
            }
        };
        apply_numbers(texture, name, &numbers[..count], keyword, line, reports);
    }
    rest
}

fn first_word(text: &str) -> (&str, &str) {
    let end = text.find(char::is_whitespace).unwrap_or(text.len());
    (&text[..end], text[end..].trim_start())
}

/// Takes numbers for as long as something is left that can be the file's name.
fn take_numbers(rest: &mut &str, numbers: &mut [f32]) -> usize {
    let mut count = 0;
    while count < numbers.len() {
        let (word, after) = first_word(rest);
        let Some(value) = word.parse::<f32>().ok().filter(|value| value.is_finite()) else { break };
        numbers[count] = value;
        count += 1;
        *rest = after;
    }
    count
}

fn apply_numbers(
    texture: &mut TextureMap,
    option: &str,
    numbers: &[f32],
    keyword: &'static str,
    line: u64,
    reports: &mut Reports,
) {
    match (option, numbers) {
        (_, []) => reports.add("options of textures without a number", Severity::Warning, line, None, || {
            format!("{keyword} has {option} without a number: it is skipped")
        }),
        // What is not written is 1 for a scale and 0 for an offset (the format's defaults).
        ("-s", numbers) => texture.scale = [numbers[0], numbers.get(1).copied().unwrap_or(1.0)],
        ("-o", numbers) => texture.offset = [numbers[0], numbers.get(1).copied().unwrap_or(0.0)],
        ("-bm", numbers) => texture.bump_multiplier = numbers[0],
        ("-mm", [base, gain]) if (*base, *gain) == (0.0, 1.0) => {}
        ("-t", numbers) if numbers.iter().all(|n| *n == 0.0) => {}
        _ => report_not_done(option, keyword, line, reports),
    }
}

fn apply_word(
    texture: &mut TextureMap,
    option: &str,
    value: &str,
    keyword: &'static str,
    line: u64,
    reports: &mut Reports,
) {
    match option {
        "-clamp" => texture.clamp = value.eq_ignore_ascii_case("on"),
        // Blending is filtering, which is always done; the rest changes nothing for a picture file.
        "-blendu" | "-blendv" | "-texres" | "-lod" | "-boost" | "-colorspace" => {}
        "-cc" if value.eq_ignore_ascii_case("off") => {}
        // `-imfchan r`, `l` or `m` is what data textures are read from anyway.
        "-imfchan" if matches!(value, "r" | "l" | "m") => {}
        _ => report_not_done(option, keyword, line, reports),
    }
}

fn report_not_done(option: &str, keyword: &'static str, line: u64, reports: &mut Reports) {
    reports.add("options of textures that are not done", Severity::Note, line, None, || {
        format!("{keyword} has {option}, which is understood but not done")
    });
}
