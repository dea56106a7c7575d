//! Typed access to a table of a scene file. Every key that is asked for is a known key, so the list
//! in an error message is always the list that is understood.

use crate::color_value::Color;
use crate::toml_tree::{Entry, Fault, Item, Value, nearest};
use gonio_light::names::UnknownName;
use std::ops::Range;
use std::str::FromStr;

/// One table being read.
pub(crate) struct TableReader<'a> {
    /// `[camera]`, `[[light]]`: for messages.
    heading: String,
    entries: &'a [Entry],
    /// The place of the whole.
    pub span: Range<usize>,
    asked: Vec<&'static str>,
}

impl<'a> TableReader<'a> {
    /// Reads `item`, which must be a table.
    pub fn new(heading: impl Into<String>, item: &'a Item) -> Result<Self, Fault> {
        let heading = heading.into();
        match &item.value {
            Value::Table(entries) => Ok(TableReader { heading, entries, span: item.span.clone(), asked: Vec::new() }),
            other => Err(Fault::at(&item.span, format!("{heading}: expected a table, found {}", other.describe()))),
        }
    }

    /// The value of `key`, whatever it is.
    fn get(&mut self, key: &'static str) -> Option<&'a Item> {
        self.asked.push(key);
        self.entries.iter().find(|e| e.key == key).map(|e| &e.item)
    }

    fn wants(key: &str, what: &str, item: &Item) -> Fault {
        Fault::at(&item.span, format!("`{key}`: expected {what}, found {}", item.value.describe()))
    }

    /// A number, whole or not.
    pub fn number(&mut self, key: &'static str) -> Result<Option<f64>, Fault> {
        let Some(item) = self.get(key) else { return Ok(None) };
        match item.value {
            Value::Number(number) => Ok(Some(number)),
            _ => Err(Self::wants(key, "a number", item)),
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
            _ => Err(Self::wants(key, "a whole number", item)),
        }
    }

    /// A string.
    pub fn text(&mut self, key: &'static str) -> Result<Option<String>, Fault> {
        let Some(item) = self.get(key) else { return Ok(None) };
        match &item.value {
            Value::Text(text) => Ok(Some(text.clone())),
            _ => Err(Self::wants(key, "a string", item)),
        }
    }

    /// `true` or `false`.
    pub fn truth(&mut self, key: &'static str) -> Result<Option<bool>, Fault> {
        let Some(item) = self.get(key) else { return Ok(None) };
        match item.value {
            Value::Truth(truth) => Ok(Some(truth)),
            _ => Err(Self::wants(key, "true or false", item)),
        }
    }

    /// Three numbers.
    pub fn vector(&mut self, key: &'static str) -> Result<Option<[f64; 3]>, Fault> {
        self.get(key).map(|item| vector_of(key, item)).transpose()
    }

    /// A list of triples of numbers.
    pub fn vectors(&mut self, key: &'static str) -> Result<Option<Vec<[f64; 3]>>, Fault> {
        let Some(item) = self.get(key) else { return Ok(None) };
        match &item.value {
            Value::List(items) => items.iter().map(|item| vector_of(key, item)).collect::<Result<_, _>>().map(Some),
            _ => Err(Self::wants(key, "a list of points [[x, y, z], ...]", item)),
        }
    }

    /// A colour.
    pub fn color(&mut self, key: &'static str) -> Result<Option<Color>, Fault> {
        let Some(item) = self.get(key) else { return Ok(None) };
        let wants = || Self::wants(key, "a colour, [r, g, b] in linear light or \"#rrggbb\" in sRGB", item);
        let color = match &item.value {
            Value::Text(text) => text.parse().map_err(|e| Fault::at(&item.span, format!("`{key}`: {e}")))?,
            Value::List(_) => Color(vector_of(key, item).map_err(|_| wants())?),
            _ => return Err(wants()),
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
            _ => Err(Self::wants(key, "a word in quotes", item)),
        }
    }

    /// A table inside of this one.
    pub fn table(&mut self, key: &'static str, heading: &str) -> Result<Option<TableReader<'a>>, Fault> {
        self.get(key).map(|item| TableReader::new(heading, item)).transpose()
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
            _ => Err(Self::wants(key, &format!("tables, each headed {heading}"), item)),
        }
    }

    /// Nothing else may stand in the table.
    pub fn finish(&self) -> Result<(), Fault> {
        match self.entries.iter().find(|e| !self.asked.contains(&e.key.as_str())) {
            None => Ok(()),
            Some(entry) => Err(Fault::at(&entry.key_span, unknown_key(&entry.key, &self.heading, &self.asked))),
        }
    }
}

/// The sentence about a key that nothing asked for.
pub(crate) fn unknown_key(key: &str, heading: &str, known: &[&'static str]) -> String {
    let meant = nearest(key, known.iter().copied()).map_or(String::new(), |word| format!("; did you mean `{word}`?"));
    let stop = if meant.is_empty() { "." } else { "" };
    format!("unknown key `{key}` in {heading}{meant}{stop} Known keys: {}", known.join(", "))
}

/// The sentence about a word that an enum does not have.
pub(crate) fn unknown_word(key: &str, unknown: &UnknownName) -> String {
    let meant = nearest(&unknown.given, unknown.known.iter().copied())
        .map_or(String::new(), |word| format!("; did you mean `{word}`?"));
    format!("`{key}`: {unknown}{meant}")
}

fn vector_of(key: &str, item: &Item) -> Result<[f64; 3], Fault> {
    let wants =
        |at: &Item, got: String| Fault::at(&at.span, format!("`{key}`: expected three numbers [x, y, z], found {got}"));
    let Value::List(items) = &item.value else { return Err(wants(item, item.value.describe())) };
    let mut vector = [0.0; 3];
    for (i, item) in items.iter().enumerate() {
        match item.value {
            Value::Number(number) if i < 3 => vector[i] = number,
            Value::Number(_) => break,
            _ => return Err(wants(item, format!("{} among them", item.value.describe()))),
        }
    }
    if items.len() == 3 { Ok(vector) } else { Err(wants(item, item.value.describe())) }
}
