//! A tree of values with their positions in the text: the common form of scene files and options before they are
//! interpreted.

use gonio_mesh::ReadError;
use std::ops::Range;
use toml::de::{DeTable, DeValue};

/// A value and its place, bytes of the text.
#[derive(Clone, Debug)]
pub(crate) struct Item {
    pub value: Value,
    pub span: Range<usize>,
}

/// A value.
#[derive(Clone, Debug)]
pub(crate) enum Value {
    Number(f64),
    Text(String),
    Truth(bool),
    List(Vec<Item>),
    Table(Vec<Entry>),
    Date,
}

/// `key = value`
#[derive(Clone, Debug)]
pub(crate) struct Entry {
    pub key: String,
    pub key_span: Range<usize>,
    pub item: Item,
}

/// An error at some bytes of the text.
#[derive(Clone, Debug)]
pub(crate) struct Fault {
    pub message: String,
    pub span: Option<Range<usize>>,
}

impl Fault {
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

impl Item {
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
pub(crate) fn parse_toml(text: &str) -> Result<Item, Fault> {
    let table = DeTable::parse(text).map_err(|e| {
        let message = e.message().trim_end_matches('.').replace('\n', ", ");
        Fault { message: format!("this is not TOML: {message}"), span: e.span() }
    })?;
    Ok(Item { span: 0..0, value: table_of(table.get_ref()) })
}

fn table_of(table: &DeTable<'_>) -> Value {
    let mut entries: Vec<Entry> = table
        .iter()
        .map(|(key, value)| Entry {
            key: key.get_ref().to_string(),
            key_span: key.span(),
            item: Item { span: value.span(), value: value_of(value.get_ref()) },
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
        DeValue::Array(items) => {
            Value::List(items.iter().map(|item| Item { span: item.span(), value: value_of(item.get_ref()) }).collect())
        }
        DeValue::Table(table) => table_of(table),
    }
}

/// Line, from 1, and column in bytes, from 1, of the byte at `offset`.
pub(crate) fn line_and_column(text: &str, offset: usize) -> (u64, u64) {
    let before = &text.as_bytes()[..offset.min(text.len())];
    let line = before.iter().filter(|&&b| b == b'\n').count() as u64 + 1;
    let column = before.len() - before.iter().rposition(|&b| b == b'\n').map_or(0, |i| i + 1);
    (line, column as u64 + 1)
}

/// The word among `known` that `given` was most likely meant to be.
pub(crate) fn nearest<'a>(given: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let given = given.to_lowercase();
    let allowed = (given.chars().count() / 3).max(1);
    known
        .into_iter()
        .map(|word| (strsim::damerau_levenshtein(&given, word), word))
        .filter(|(distance, word)| *distance <= allowed || (given.len() >= 3 && word.starts_with(given.as_str())))
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, word)| word)
}
