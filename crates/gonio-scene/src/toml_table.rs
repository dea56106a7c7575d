//! The tables of scene files, options and other files before they are interpreted: a tree of values with their positions in the
//! text, and typed access to it.
//!
//! Every key that is read is a known key, so the list in an error message is complete.

use crate::color_value::Color;
use gonio_light::names::UnknownName;
use gonio_mesh::ReadError;
use std::ops::Range;
use std::str::FromStr;
use toml::de::{DeTable, DeValue};

/// A value and its place, bytes of the text.
#[derive(Clone, Debug)]
pub struct TomlItem {
    /// The value.
    pub value: Value,
    /// Its place.
    pub span: Range<usize>,
}

/// A value.
#[derive(Clone, Debug)]
pub enum Value {
    /// A number, whole or not.
    Number(f64),
    /// A string.
    Text(String),
    /// `true` or `false`.
    Truth(bool),
    /// A list.
    List(Vec<TomlItem>),
    /// A table, in the order of the text.
    Table(Vec<Entry>),
    /// A date or a time.
    Date,
}

/// `key = value`
#[derive(Clone, Debug)]
pub struct Entry {
    /// The key.
    pub key: String,
    /// Its place.
    pub key_span: Range<usize>,
    /// Its value.
    pub item: TomlItem,
}

/// An error at some bytes of the text.
#[derive(Clone, Debug)]
pub struct Fault {
    /// What is wrong, in one sentence.
    pub message: String,
    /// The place.
    pub span: Option<Range<usize>>,
}

impl Fault {
    /// An error at a place.
    pub fn at(span: &Range<usize>, message: impl Into<String>) -> Self {
        Fault { message: message.into(), span: Some(span.clone()) }
    }

    /// Converts to an error with line and column of `text`.
    pub fn in_text(self, text: &str) -> ReadError {
        let error = ReadError::new(self.message);
        match self.span {
            None => error,
            Some(span) => {
                let (line, column) = line_and_column(text, span.start);
                error.at(line, Some(column))
            }
        }
    }
}

impl Value {
    /// The type of the value in error messages.
    pub fn describe(&self) -> String {
        match self {
            Value::Number(_) => "a number".into(),
            Value::Text(_) => "a string".into(),
            Value::Truth(_) => "true or false".into(),
            Value::List(items) => format!("a list of {}", items.len()),
            Value::Table(_) => "a table".into(),
            Value::Date => "a date".into(),
        }
    }
}

impl TomlItem {
    /// The place of the value at `path` (`light[0].motion.period`), or of what comes nearest to it
    /// on the way there.
    pub fn locate(&self, path: &str) -> Range<usize> {
        let mut here = self;
        let mut span = self.span.clone();
        for step in path.split(['.', '[']) {
            let next = match (&here.value, step.strip_suffix(']').map(str::parse::<usize>)) {
                (Value::List(items), Some(Ok(index))) => items.get(index),
                (Value::Table(entries), None) => entries.iter().find(|e| e.key == step).map(|e| &e.item),
                _ => None,
            };
            let Some(next) = next else { break };
            here = next;
            span = next.span.clone();
        }
        span
    }
}

/// The tree of a TOML text.
///
/// # Errors
/// The text is not TOML.
pub fn parse_toml(text: &str) -> Result<TomlItem, Fault> {
    let table = DeTable::parse(text).map_err(|e| {
        let message = e.message().trim_end_matches('.').replace('\n', ", ");
        Fault { message: format!("this is not TOML: {message}"), span: e.span() }
    })?;
    Ok(TomlItem { span: 0..0, value: table_of(table.get_ref()) })
}

fn table_of(table: &DeTable<'_>) -> Value {
    let mut entries: Vec<Entry> = table
        .iter()
        .map(|(key, value)| Entry {
            key: key.get_ref().to_string(),
            key_span: key.span(),
            item: TomlItem { span: value.span(), value: value_of(value.get_ref()) },
        })
        .collect();
    entries.sort_by_key(|e| e.key_span.start);
    Value::Table(entries)
}

fn value_of(value: &DeValue<'_>) -> Value {
    match value {
        DeValue::String(text) => Value::Text(text.to_string()),
        // Neither parse can fail: TOML's own grammar has been checked. NaN is refused further on.
        DeValue::Integer(number) => Value::Number(
            i128::from_str_radix(number.as_str(), number.radix()).map_or(f64::INFINITY, |whole| whole as f64),
        ),
        DeValue::Float(number) => Value::Number(number.as_str().parse().unwrap_or(f64::NAN)),
        DeValue::Boolean(truth) => Value::Truth(*truth),
        DeValue::Datetime(_) => Value::Date,
        DeValue::Array(items) => Value::List(
            items.iter().map(|item| TomlItem { span: item.span(), value: value_of(item.get_ref()) }).collect(),
        ),
        DeValue::Table(table) => table_of(table),
    }
}

/// Line, from 1, and column in bytes, from 1, of the byte at `offset`.
pub fn line_and_column(text: &str, offset: usize) -> (u64, u64) {
    let before = &text.as_bytes()[..offset.min(text.len())];
    let line = before.iter().filter(|&&b| b == b'\n').count() as u64 + 1;
    let column = before.len() - before.iter().rposition(|&b| b == b'\n').map_or(0, |i| i + 1);
    (line, column as u64 + 1)
}

/// One table being read.
pub struct TableReader<'a> {
    /// `[camera]`, `[[light]]`: for messages.
    heading: String,
    entries: &'a [Entry],
    /// The place of the whole.
    pub span: Range<usize>,
    known_keys: Vec<&'static str>,
}

impl<'a> TableReader<'a> {
    /// Reads `item`, which must be a table.
    pub fn new(heading: impl Into<String>, item: &'a TomlItem) -> Result<Self, Fault> {
        let heading = heading.into();
        match &item.value {
            Value::Table(entries) => {
                Ok(TableReader { heading, entries, span: item.span.clone(), known_keys: Vec::new() })
            }
            other => Err(Fault::at(&item.span, format!("{heading}: expected a table, found {}", other.describe()))),
        }
    }

    /// The value of `key`, of any type.
    fn get(&mut self, key: &'static str) -> Option<&'a TomlItem> {
        self.known_keys.push(key);
        self.entries.iter().find(|e| e.key == key).map(|e| &e.item)
    }

    fn expected(key: &str, what: &str, item: &TomlItem) -> Fault {
        Fault::at(&item.span, format!("`{key}`: expected {what}, found {}", item.value.describe()))
    }

    /// A number, whole or not.
    pub fn number(&mut self, key: &'static str) -> Result<Option<f64>, Fault> {
        let Some(item) = self.get(key) else { return Ok(None) };
        match item.value {
            Value::Number(number) => Ok(Some(number)),
            _ => Err(Self::expected(key, "a number", item)),
        }
    }

    /// A whole number, not negative. Ranges are checked elsewhere.
    pub fn whole(&mut self, key: &'static str) -> Result<Option<u32>, Fault> {
        let Some(item) = self.get(key) else { return Ok(None) };
        match item.value {
            Value::Number(n) if n.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(&n) => Ok(Some(n as u32)),
            Value::Number(n) => {
                Err(Fault::at(&item.span, format!("`{key}`: expected a whole number of at least 0, found {n}")))
            }
            _ => Err(Self::expected(key, "a whole number", item)),
        }
    }

    /// A string.
    pub fn text(&mut self, key: &'static str) -> Result<Option<String>, Fault> {
        let Some(item) = self.get(key) else { return Ok(None) };
        match &item.value {
            Value::Text(text) => Ok(Some(text.clone())),
            _ => Err(Self::expected(key, "a string", item)),
        }
    }

    /// `true` or `false`.
    pub fn truth(&mut self, key: &'static str) -> Result<Option<bool>, Fault> {
        let Some(item) = self.get(key) else { return Ok(None) };
        match item.value {
            Value::Truth(truth) => Ok(Some(truth)),
            _ => Err(Self::expected(key, "true or false", item)),
        }
    }

    /// The index of one of the words `known`.
    pub fn choice(&mut self, key: &'static str, known: &'static [&'static str]) -> Result<Option<usize>, Fault> {
        let Some(item) = self.get(key) else { return Ok(None) };
        let Value::Text(text) = &item.value else { return Err(Self::expected(key, "a word in quotes", item)) };
        match known.iter().position(|word| word == text) {
            Some(found) => Ok(Some(found)),
            None => {
                let meant = nearest_word(text, known.iter().copied());
                let meant = meant.map_or(String::new(), |word| format!("; did you mean `{word}`?"));
                let message = format!("`{key}`: unknown word `{text}`, expected {}{meant}", known.join(", "));
                Err(Fault::at(&item.span, message))
            }
        }
    }

    /// A list of strings.
    pub fn texts(&mut self, key: &'static str) -> Result<Option<Vec<String>>, Fault> {
        let Some(item) = self.get(key) else { return Ok(None) };
        let Value::List(items) = &item.value else { return Err(Self::expected(key, "a list of strings", item)) };
        let text = |item: &TomlItem| match &item.value {
            Value::Text(text) => Ok(text.clone()),
            _ => Err(Self::expected(key, "strings in the list", item)),
        };
        items.iter().map(text).collect::<Result<_, _>>().map(Some)
    }

    /// The entries of a table with names that the user chose.
    pub fn entries(&mut self, key: &'static str, heading: &str) -> Result<&'a [Entry], Fault> {
        Ok(self.table(key, heading)?.map_or(&[], |table| table.entries))
    }

    /// The place of the value of `key`, or of the whole table.
    #[must_use]
    pub fn place(&self, key: &str) -> Range<usize> {
        self.entries.iter().find(|e| e.key == key).map_or(self.span.clone(), |e| e.item.span.clone())
    }

    /// Three numbers.
    pub fn vector(&mut self, key: &'static str) -> Result<Option<[f64; 3]>, Fault> {
        self.get(key).map(|item| vector_of(key, item)).transpose()
    }

    /// Two numbers; `what` describes them.
    pub fn pair(&mut self, key: &'static str, what: &str) -> Result<Option<[f64; 2]>, Fault> {
        self.get(key).map(|item| numbers_of(key, what, item)).transpose()
    }

    /// A list of triples of numbers.
    pub fn vectors(&mut self, key: &'static str) -> Result<Option<Vec<[f64; 3]>>, Fault> {
        let Some(item) = self.get(key) else { return Ok(None) };
        match &item.value {
            Value::List(items) => items.iter().map(|item| vector_of(key, item)).collect::<Result<_, _>>().map(Some),
            _ => Err(Self::expected(key, "a list of points [[x, y, z], ...]", item)),
        }
    }

    /// A list of pairs of wavelengths and values.
    pub fn spectrum(&mut self, key: &'static str) -> Result<Option<Vec<[f64; 2]>>, Fault> {
        let Some(item) = self.get(key) else { return Ok(None) };
        let what = "two numbers [wavelength in nm, value]";
        match &item.value {
            Value::List(items) => items.iter().map(|i| numbers_of(key, what, i)).collect::<Result<_, _>>().map(Some),
            _ => Err(Self::expected(key, "a list of pairs [[wavelength in nm, value], ...]", item)),
        }
    }

    /// A colour.
    pub fn color(&mut self, key: &'static str) -> Result<Option<Color>, Fault> {
        let Some(item) = self.get(key) else { return Ok(None) };
        let expected = || Self::expected(key, "a colour, [r, g, b] in linear light or \"#rrggbb\" in sRGB", item);
        let color = match &item.value {
            Value::Text(text) => text.parse().map_err(|e| Fault::at(&item.span, format!("`{key}`: {e}")))?,
            Value::List(_) => Color(vector_of(key, item).map_err(|_| expected())?),
            _ => return Err(expected()),
        };
        if color.0.iter().any(|v| !v.is_finite() || *v < 0.0) {
            let message = format!("`{key}` is a colour: its numbers must be finite and not negative");
            return Err(Fault::at(&item.span, message));
        }
        Ok(Some(color))
    }

    /// One of the words of an enum.
    pub fn word<E: FromStr<Err = UnknownName>>(&mut self, key: &'static str) -> Result<Option<E>, Fault> {
        let Some(item) = self.get(key) else { return Ok(None) };
        match &item.value {
            Value::Text(text) => match text.parse() {
                Ok(value) => Ok(Some(value)),
                Err(unknown) => Err(Fault::at(&item.span, unknown_word(key, &unknown))),
            },
            _ => Err(Self::expected(key, "a word in quotes", item)),
        }
    }

    /// A table inside this one.
    pub fn table(&mut self, key: &'static str, heading: &str) -> Result<Option<TableReader<'a>>, Fault> {
        self.get(key).map(|item| TableReader::new(heading, item)).transpose()
    }

    /// A table of tables with names that the user chose; `heading` is that of the outer one.
    pub fn tables_by_name(
        &mut self,
        key: &'static str,
        heading: &str,
    ) -> Result<Vec<(String, TableReader<'a>)>, Fault> {
        let Some(table) = self.table(key, heading)? else { return Ok(Vec::new()) };
        let named = |entry: &'a Entry| {
            let heading = format!("{}.{}]", heading.trim_end_matches(']'), entry.key);
            Ok((entry.key.clone(), TableReader::new(heading, &entry.item)?))
        };
        table.entries.iter().map(named).collect()
    }

    /// A list of tables, `[[key]]`.
    pub fn tables(&mut self, key: &'static str) -> Result<Vec<TableReader<'a>>, Fault> {
        let Some(item) = self.get(key) else { return Ok(Vec::new()) };
        let heading = format!("[[{key}]]");
        match &item.value {
            Value::List(items) => items.iter().map(|item| TableReader::new(heading.as_str(), item)).collect(),
            Value::Table(_) => {
                let message = format!("`{key}` is a list of tables: write {heading} with two brackets");
                Err(Fault::at(&item.span, message))
            }
            _ => Err(Self::expected(key, &format!("tables, each headed {heading}"), item)),
        }
    }

    /// Reports a key that was not read.
    pub fn finish(&self) -> Result<(), Fault> {
        match self.entries.iter().find(|e| !self.known_keys.contains(&e.key.as_str())) {
            None => Ok(()),
            Some(entry) => Err(Fault::at(&entry.key_span, unknown_key(&entry.key, &self.heading, &self.known_keys))),
        }
    }
}

/// The message about an unknown key.
pub(crate) fn unknown_key(key: &str, heading: &str, known: &[&'static str]) -> String {
    let meant =
        nearest_word(key, known.iter().copied()).map_or(String::new(), |word| format!("; did you mean `{word}`?"));
    let stop = if meant.is_empty() { "." } else { "" };
    format!("unknown key `{key}` in {heading}{meant}{stop} Known keys: {}", known.join(", "))
}

/// The message about an unknown word of an enum.
pub(crate) fn unknown_word(key: &str, unknown: &UnknownName) -> String {
    let meant = nearest_word(&unknown.given, unknown.known.iter().copied())
        .map_or(String::new(), |word| format!("; did you mean `{word}`?"));
    format!("`{key}`: {unknown}{meant}")
}

fn vector_of(key: &str, item: &TomlItem) -> Result<[f64; 3], Fault> {
    numbers_of(key, "three numbers [x, y, z]", item)
}

/// A list of `N` numbers, which `what` describes.
fn numbers_of<const N: usize>(key: &str, what: &str, item: &TomlItem) -> Result<[f64; N], Fault> {
    let expected = |at: &TomlItem, got: String| Fault::at(&at.span, format!("`{key}`: expected {what}, found {got}"));
    let Value::List(items) = &item.value else { return Err(expected(item, item.value.describe())) };
    let mut numbers = [0.0; N];
    for (i, item) in items.iter().enumerate() {
        match item.value {
            Value::Number(number) if i < N => numbers[i] = number,
            Value::Number(_) => break,
            _ => return Err(expected(item, format!("{} among them", item.value.describe()))),
        }
    }
    if items.len() == N { Ok(numbers) } else { Err(expected(item, item.value.describe())) }
}

/// The word among `known` that `given` was probably meant to be: one letter in three may be wrong, or the end missing.
pub fn nearest_word<'a>(given: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let given = given.to_lowercase();
    let allowed = (given.chars().count() / 3).max(1);
    known
        .into_iter()
        .map(|word| (word.to_lowercase(), word))
        .map(|(lower, word)| (strsim::damerau_levenshtein(&given, &lower), lower, word))
        .filter(|(distance, lower, _)| *distance <= allowed || (given.len() >= 3 && lower.starts_with(&given)))
        .min_by_key(|(distance, ..)| *distance)
        .map(|(.., word)| word)
}
