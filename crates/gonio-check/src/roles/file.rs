//! Reads `names.toml`, which assigns roles to names that gonio does not recognise.

use super::role::Role;
use gonio_language::tr;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::fmt;
use toml::{Spanned, Value};

/// The entry of one name in `names.toml`.
#[derive(Clone, Debug, PartialEq)]
pub enum Meaning {
    /// It has this role.
    Role(Role),
    /// It always has this value.
    Value(Vec<f32>),
}

/// The content of a `names.toml`:
///
/// ```toml
/// exercise = "ex04"
/// [names]
/// sunPlace = "light-pos"
/// "lamps[1].place" = "light-pos-1"
/// tint = [1.0, 0.5, 0.25]
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NamesFile {
    /// The meanings by the names in the shader.
    pub names: BTreeMap<String, Meaning>,
    /// The roles that the source shows of other names; they are not certain.
    pub by_use: BTreeMap<String, Role>,
    /// The lines of the names in the file, from 1.
    pub lines: BTreeMap<String, u32>,
    /// The exercise of the folder, for editors. A check states its own.
    pub exercise: Option<String>,
}

/// An error in a `names.toml`, with its line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NamesError {
    /// Line, from 1.
    pub line: u32,
    /// The error, and what to write instead.
    pub message: String,
}

impl fmt::Display for NamesError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&tr!("check-inputs-names-toml-line", line = self.line, message = self.message))
    }
}

impl std::error::Error for NamesError {}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Document {
    exercise: Option<String>,
    #[serde(default)]
    names: BTreeMap<String, Spanned<Value>>,
}

impl NamesFile {
    /// Reads the text of a `names.toml`.
    ///
    /// # Errors
    /// Returns a [`NamesError`] if it is not TOML, has another table than `[names]`, or names an unknown role.
    pub fn parse(text: &str) -> Result<Self, NamesError> {
        let document: Document = toml::from_str(text).map_err(|error| NamesError {
            line: line_at(text, error.span().map_or(0, |span| span.start)),
            message: error.message().to_owned(),
        })?;
        let mut file = Self { exercise: document.exercise, ..Self::default() };
        for (name, value) in document.names {
            let line = line_at(text, value.span().start);
            file.take(name, value.into_inner(), line)?;
        }
        Ok(file)
    }

    fn take(&mut self, name: String, value: Value, line: u32) -> Result<(), NamesError> {
        let error = |message: String| NamesError { line, message };
        let meaning = match value {
            Value::String(role) => Meaning::Role(role.parse().map_err(|unknown| error(format!("{unknown}")))?),
            // TOML reads `light.place = "light-pos"` as a table.
            Value::Table(fields) => {
                for (field, value) in fields {
                    self.take(format!("{name}.{field}"), value, line)?;
                }
                return Ok(());
            }
            Value::Array(items) => {
                let numbers = items.iter().map(number).collect::<Option<Vec<f32>>>();
                match numbers {
                    Some(numbers) if matches!(numbers.len(), 1..=16) => Meaning::Value(numbers),
                    _ => {
                        return Err(error(tr!("check-inputs-must-be-a-list-of-1", name = name)));
                    }
                }
            }
            other => Meaning::Value(vec![
                number(&other).ok_or_else(|| error(tr!("check-inputs-must-be-a-role-such-as", name = name)))?,
            ]),
        };
        self.lines.insert(name.clone(), line);
        self.names.insert(name, meaning);
        Ok(())
    }

    /// Returns the meaning of a name; `lights[0]` and `lights` are the same.
    #[must_use]
    pub fn get(&self, name: &str) -> Option<&Meaning> {
        self.names.get(name).or_else(|| self.names.get(name.strip_suffix("[0]")?))
    }
}

#[expect(clippy::cast_possible_truncation, reason = "a shader's numbers are single precision")]
fn number(value: &Value) -> Option<f32> {
    match value {
        Value::Float(number) => Some(*number as f32),
        Value::Integer(number) => Some(*number as f32),
        Value::Boolean(yes) => Some(f32::from(u8::from(*yes))),
        _ => None,
    }
}

fn line_at(text: &str, offset: usize) -> u32 {
    let before = text.as_bytes().get(..offset).unwrap_or(text.as_bytes());
    u32::try_from(before.iter().filter(|&&b| b == b'\n').count() + 1).unwrap_or(u32::MAX)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    #[test]
    fn roles_and_values_are_read() {
        let text = "# mine\n[names]\nsun = \"light-pos\"\nlamp.place = \"light-pos-1\"\n\"l[2].p\" = \"light-pos-2\"\n\
                    tint = [1, 0.5, 0.25]\nk = 3\non = true\nall = \"model\"\n";
        let file = NamesFile::parse(text).unwrap();
        assert_eq!(file.get("sun"), Some(&Meaning::Role(Role::LightPos(0))));
        assert_eq!(file.get("lamp.place"), Some(&Meaning::Role(Role::LightPos(1))));
        assert_eq!(file.get("l[2].p"), Some(&Meaning::Role(Role::LightPos(2))));
        assert_eq!(file.get("tint"), Some(&Meaning::Value(vec![1.0, 0.5, 0.25])));
        assert_eq!(file.get("k[0]"), Some(&Meaning::Value(vec![3.0])));
        assert_eq!(file.get("on"), Some(&Meaning::Value(vec![1.0])));
        assert_eq!(file.get("nothing"), None);
        assert_eq!(NamesFile::parse("").unwrap(), NamesFile::default());
        let file = NamesFile::parse("exercise = \"ex04\"\n[names]\nk = 3\n").unwrap();
        assert_eq!((file.exercise.as_deref(), file.names.len()), (Some("ex04"), 1));
    }

    #[test]
    fn errors_name_the_line_and_the_nearest_role() {
        for (text, message) in [
            (
                "[names]\n\nsun = \"lihgt-pos\"\n",
                "names.toml, line 3: unknown role `lihgt-pos`: did you mean `light-pos`?",
            ),
            (
                "[names]\nsun = []\n",
                "names.toml, line 2: `sun` must be a list of 1 to 16 numbers, such as [1.0, 0.5, 0.0]",
            ),
            (
                "[names]\nday = 2024-01-01\n",
                "names.toml, line 2: `day` must be a role such as \"light-pos\", a number or a list of numbers",
            ),
        ] {
            assert_eq!(NamesFile::parse(text).unwrap_err().to_string(), message);
        }
        for (text, line) in [("[names]\nsun = \n", 2), ("\n\n[nams]\n", 3), ("[names]\na = 1\na = 2\n", 3)] {
            assert_eq!(NamesFile::parse(text).unwrap_err().line, line, "{text}");
        }
    }
}
