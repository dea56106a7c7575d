//! Lights and materials as options of a command line: the same keys as in a scene file, in one line.

use crate::part_material::PartMaterial;
use crate::scene_file::{LightSpec, MaterialOverride};
use crate::toml_file;
use crate::toml_table::{Entry, Fault, TableReader, TomlItem, Value, nearest_word, unknown_key};
use crate::validate;
use gonio_light::optics::Medium;
use std::ops::Range;

/// The keys that belong to a light's motion; `motion` itself names its kind.
const OF_MOTION: [&str; 5] = ["period", "amplitude", "center", "axis", "points"];
const OF_LIGHT: [&str; 20] = [
    "name",
    "enabled",
    "position",
    "direction",
    "radius",
    "size",
    "color",
    "spectrum",
    "intensity",
    "constant",
    "linear",
    "quadratic",
    "inner_angle",
    "outer_angle",
    "motion",
    "period",
    "amplitude",
    "center",
    "axis",
    "points",
];
const COLORS: [&str; 7] = ["color", "ambient", "diffuse", "specular", "emitted", "tint", "absorption"];

impl LightSpec {
    /// `KIND key=value ...`, for example `point position=1,2,3 color=#ff8800 intensity=2`: the keys of
    /// a `[[light]]` in a scene file, with `-` or `_`, vectors with commas. A motion is written
    /// `motion=oscillate period=2 amplitude=0,0,2`; the points of a path have semicolons between them. `off` after the
    /// kind means `enabled=false`.
    ///
    /// The error is one sentence that begins with the place in the text, from 1.
    pub fn from_option_text(text: &str) -> Result<LightSpec, String> {
        read_light(text).map_err(|fault| in_option(text, fault))
    }
}

impl MaterialOverride {
    /// `key=value ...`, for example `diffuse=#ff8800 shininess=32`: the keys of an object's
    /// `material` in a scene file. Commas between the pairs are allowed too. A medium's name alone (`glass`) means
    /// `medium=glass`, `mirror` means `reflectivity=1`.
    pub fn from_option_text(text: &str) -> Result<MaterialOverride, String> {
        read_material(text).map_err(|fault| in_option(text, fault))
    }
}

impl PartMaterial {
    /// `NAME:key=value ...`, for example `Cup:diffuse=#ff8800,shininess=32`: a name of a part, which may contain colons, and the
    /// values of [`MaterialOverride::from_option_text`].
    pub fn from_option_text(text: &str) -> Result<PartMaterial, String> {
        let before_values = text.find('=').unwrap_or(text.len());
        let Some(colon) = text[..before_values].rfind(':').filter(|colon| *colon > 0) else {
            return Err(format!("`{text}`: expected NAME:KEY=VALUE,..., such as Cup:diffuse=#ff8800,shininess=32"));
        };
        let material = MaterialOverride::from_option_text(&text[colon + 1..])?;
        if material.is_empty() {
            return Err(format!("`{text}`: there are no values after the name of the part"));
        }
        Ok(PartMaterial { part: text[..colon].to_owned(), material })
    }
}

fn in_option(text: &str, fault: Fault) -> String {
    match fault.span {
        Some(span) if span.start > 0 => format!("`{text}`, at {}: {}", span.start + 1, fault.message),
        _ => format!("`{text}`: {}", fault.message),
    }
}

fn read_light(text: &str) -> Result<LightSpec, Fault> {
    let words = words(text, |c| c.is_whitespace());
    let whole = 0..text.len();
    let Some((first, rest)) = words.split_first().filter(|(first, _)| !first.1.contains('=')) else {
        let message = "a light begins with its kind of light: ambient, directional, point, spot or rectangle";
        return Err(Fault::at(&whole, message));
    };
    let mut light = vec![entry("kind", &first.0, Value::Text(first.1.to_owned()), &first.0)];
    let (switches, rest) = rest.split_at(rest.iter().take_while(|(_, word)| word.eq_ignore_ascii_case("off")).count());
    for (span, _) in switches {
        light.push(entry("enabled", span, Value::Truth(false), span));
    }
    let mut motion: Vec<Entry> = Vec::new();
    let mut moves = false;
    for pair in pairs(rest)? {
        if light.iter().any(|known| known.key == pair.key) {
            return Err(Fault::at(&pair.key_span, format!("`{}` is given twice", pair.key)));
        }
        if !OF_LIGHT.contains(&pair.key.as_str()) {
            return Err(Fault::at(&pair.key_span, unknown_key(&pair.key, "a light", &OF_LIGHT)));
        }
        if pair.key == "motion" {
            moves = true;
            motion.push(Entry { key: "kind".into(), ..pair });
        } else if OF_MOTION.contains(&pair.key.as_str()) {
            motion.push(pair);
        } else {
            light.push(pair);
        }
    }
    if let Some(first) = motion.first() {
        if !moves {
            let message = "a light that moves needs motion=oscillate, motion=circle or motion=path";
            return Err(Fault::at(&first.key_span, message));
        }
        let span = first.key_span.clone();
        light.push(entry("motion", &span, Value::Table(motion), &span));
    }
    let item = TomlItem { value: Value::Table(light), span: whole };
    let spec = toml_file::read_light(TableReader::new("a light", &item)?)?;
    validate::check_light("", &spec).map_err(|p| Fault::at(&item.locate(p.path.trim_start_matches('.')), p.message))?;
    Ok(spec)
}

fn read_material(text: &str) -> Result<MaterialOverride, Fault> {
    let words = words(text, |c| c.is_whitespace() || c == ',');
    // Names come first: a later word without `=` goes on with the value before it.
    let named = words.iter().take_while(|(_, word)| !word.contains('=')).count();
    let mut entries = Vec::new();
    for (span, word) in &words[..named] {
        entries.push(preset(span, word)?);
    }
    entries.extend(pairs(&words[named..])?);
    if let Some(twice) = entries.iter().enumerate().find_map(|(i, e)| {
        let known = entries[..i].iter().any(|earlier| earlier.key == e.key);
        known.then_some(e)
    }) {
        return Err(Fault::at(&twice.key_span, format!("`{}` is given twice", twice.key)));
    }
    let item = TomlItem { value: Value::Table(entries), span: 0..text.len() };
    let spec = toml_file::read_material(TableReader::new("a material", &item)?)?;
    validate::check_material("", &spec)
        .map_err(|p| Fault::at(&item.locate(p.path.trim_start_matches('.')), p.message))?;
    Ok(spec)
}

/// The entry that a word without `=` abbreviates.
fn preset(span: &Range<usize>, word: &str) -> Result<Entry, Fault> {
    if word.eq_ignore_ascii_case("mirror") {
        return Ok(entry("reflectivity", span, Value::Number(1.0), span));
    }
    match word.parse::<Medium>() {
        Ok(medium) => Ok(entry("medium", span, Value::Text(medium.name().to_owned()), span)),
        Err(_) => {
            let known = || std::iter::once("mirror").chain(Medium::ALL.iter().map(|m| m.name()));
            let names = known().collect::<Vec<_>>().join(", ");
            let meant = nearest_word(word, known()).map_or(String::new(), |known| format!("; did you mean `{known}`?"));
            Err(Fault::at(span, format!("`{word}` has no value: expected key=value or one of {names}{meant}")))
        }
    }
}

fn entry(key: &str, key_span: &Range<usize>, value: Value, span: &Range<usize>) -> Entry {
    Entry { key: key.into(), key_span: key_span.clone(), item: TomlItem { value, span: span.clone() } }
}

/// The words with their places.
fn words(text: &str, separator: impl Fn(char) -> bool) -> Vec<(Range<usize>, &str)> {
    let mut words = Vec::new();
    let mut start = None;
    for (i, c) in text.char_indices().chain([(text.len(), ' ')]) {
        match (start, separator(c) || i == text.len()) {
            (None, false) => start = Some(i),
            (Some(from), true) => {
                words.push((from..i, &text[from..i]));
                start = None;
            }
            _ => {}
        }
    }
    words
}

/// `key=value` pairs; a word without `=` goes on with the value before it (`1, 2, 3`).
fn pairs(words: &[(Range<usize>, &str)]) -> Result<Vec<Entry>, Fault> {
    let mut pairs: Vec<(String, Range<usize>, String, Range<usize>)> = Vec::new();
    for (span, word) in words {
        match (word.split_once('='), pairs.last_mut()) {
            (Some((key, value)), _) => {
                let name = key.replace('-', "_");
                let key_span = span.start..span.start + key.len();
                if pairs.iter().any(|(known, ..)| *known == name) {
                    return Err(Fault::at(&key_span, format!("`{name}` is given twice")));
                }
                pairs.push((name, key_span.clone(), value.to_owned(), key_span.end + 1..span.end));
            }
            (None, Some((_, _, value, value_span))) => {
                if !value.is_empty() && !value.ends_with([',', ';']) && !word.starts_with([',', ';']) {
                    value.push(',');
                }
                value.push_str(word);
                value_span.end = span.end;
            }
            (None, None) => {
                return Err(Fault::at(span, format!("`{word}` has no value: expected key=value")));
            }
        }
    }
    pairs
        .into_iter()
        .map(|(key, key_span, text, span)| {
            let text = text.trim_matches(['"', '\'']);
            if text.is_empty() {
                return Err(Fault::at(&key_span, format!("`{key}` has no value: expected key=value")));
            }
            let value = value_of(&key, text, &span);
            Ok(Entry { key, key_span, item: TomlItem { value, span } })
        })
        .collect()
}

/// `1` a number, `1,2,3` a list, `1,2,3;4,5,6` a list of lists, `true` and `false`, else text.
fn value_of(key: &str, text: &str, span: &Range<usize>) -> Value {
    let item = |value: Value| TomlItem { value, span: span.clone() };
    if ["points", "spectrum", "diffuse_spectrum"].contains(&key) {
        let points = text.split(';').map(str::trim).filter(|t| !t.is_empty());
        return Value::List(points.map(|t| item(value_of("", t, span))).collect());
    }
    if key == "name" {
        return Value::Text(text.to_owned());
    }
    if let Ok(truth) = text.parse() {
        return Value::Truth(truth);
    }
    let numbers: Option<Vec<f64>> = text.split(',').map(|t| t.trim().parse().ok()).collect();
    match numbers.as_deref() {
        // A colour of one number is grey, as in every other option.
        Some(&[grey]) if COLORS.contains(&key) => Value::List(vec![item(Value::Number(grey)); 3]),
        Some(&[number]) => Value::Number(number),
        Some(numbers) => Value::List(numbers.iter().map(|n| item(Value::Number(*n))).collect()),
        None => Value::Text(text.to_owned()),
    }
}
