//! A place in the JSON of a file: the value, and the path by which messages name it.
//!
//! The JSON is read as it stands rather than into structures: so a wrong value in one place costs no more than that
//! place, a message names it (`accessors[3].count`), and a material can say what the file says word by word.

use crate::ReadError;
use serde::Serialize;
use serde_json::Value;
use serde_json::ser::Formatter;
use std::fmt::Write as _;
use std::io;

/// `materials[0].extensions.NAME.TEXTURE.extensions.KHR_texture_transform.offset` has 9 steps.
const MOST_STEPS: usize = 12;

/// How much of a value is quoted, in bytes.
const MOST_QUOTED: usize = 100;

/// What an index, a count or a code is, for messages.
const UNSIGNED: &str = "a non-negative integer";

/// A value and where it stands.
#[derive(Clone, Copy)]
pub(super) struct JsonRef<'v> {
    pub value: &'v Value,
    steps: [Step<'v>; MOST_STEPS],
    depth: usize,
}

#[derive(Clone, Copy)]
enum Step<'v> {
    Key(&'v str),
    Index(usize),
}

impl<'v> JsonRef<'v> {
    /// The whole file.
    pub fn root(value: &'v Value) -> Self {
        JsonRef { value, steps: [Step::Index(0); MOST_STEPS], depth: 0 }
    }

    fn below(self, value: &'v Value, step: Step<'v>) -> Self {
        let mut below = JsonRef { value, ..self };
        // Deeper than any place of glTF: the path stays that of the place above.
        if let Some(free) = below.steps.get_mut(self.depth) {
            *free = step;
            below.depth += 1;
        }
        below
    }

    /// A member of an object; none where it is absent or null.
    pub fn get(self, key: &'v str) -> Option<JsonRef<'v>> {
        let value = self.value.get(key).filter(|value| !value.is_null())?;
        Some(self.below(value, Step::Key(key)))
    }

    /// An element of an array.
    pub fn item(self, index: usize) -> Option<JsonRef<'v>> {
        Some(self.below(self.value.as_array()?.get(index)?, Step::Index(index)))
    }

    /// The elements of the array `key`; none where it is absent.
    pub fn list(self, key: &'v str) -> Result<impl Iterator<Item = JsonRef<'v>>, ReadError> {
        let list = self.get(key);
        if let Some(list) = list
            && !list.value.is_array()
        {
            return Err(list.fault("an array"));
        }
        let length = self.count(key);
        Ok((0..length).filter_map(move |i| list?.item(i)))
    }

    /// How many elements the array `key` has; 0 where it is absent.
    pub fn count(self, key: &str) -> usize {
        self.value.get(key).and_then(Value::as_array).map_or(0, Vec::len)
    }

    /// The members of an object with their names.
    pub fn members(self) -> impl Iterator<Item = (&'v str, JsonRef<'v>)> {
        let members = self.value.as_object().into_iter().flatten();
        members.map(move |(key, value)| (key.as_str(), self.below(value, Step::Key(key))))
    }

    /// What an extension adds to this object.
    pub fn extension(self, name: &'v str) -> Option<JsonRef<'v>> {
        self.get("extensions")?.get(name)
    }

    /// What the array `list` of the file has at the place that the number `key` names.
    pub fn target(
        self,
        root: JsonRef<'v>,
        key: &'v str,
        list: &'v str,
    ) -> Result<Option<(usize, JsonRef<'v>)>, ReadError> {
        let Some(index) = self.index(key)? else { return Ok(None) };
        match root.get(list).and_then(|list| list.item(index)) {
            Some(found) => Ok(Some((index, found))),
            None => {
                let written = self.written(key);
                Err(ReadError::new(format!("{written}, but the file has {} {list}", root.count(list))))
            }
        }
    }

    /// The value as a whole number from 0: JSON makes no difference between `1`, `1.0` and `1e0`.
    pub fn as_unsigned(self) -> Option<u64> {
        let whole = |v: f64| (v.fract() == 0.0 && (0.0..=9e15).contains(&v)).then_some(v as u64);
        self.value.as_u64().or_else(|| self.value.as_f64().and_then(whole))
    }

    /// The same, as an index: what is no index is an error, and what is too large for one is none of any array.
    pub fn as_index(self) -> Result<usize, ReadError> {
        let number = self.as_unsigned().ok_or_else(|| self.fault(UNSIGNED))?;
        Ok(usize::try_from(number).unwrap_or(usize::MAX))
    }

    /// A whole number from 0.
    pub fn unsigned(self, key: &'v str) -> Result<Option<u64>, ReadError> {
        let Some(at) = self.get(key) else { return Ok(None) };
        at.as_unsigned().map(Some).ok_or_else(|| at.fault(UNSIGNED))
    }

    /// The same, as an index or a count.
    pub fn index(self, key: &'v str) -> Result<Option<usize>, ReadError> {
        self.get(key).map(JsonRef::as_index).transpose()
    }

    /// A number.
    pub fn number(self, key: &'v str) -> Result<Option<f64>, ReadError> {
        let Some(at) = self.get(key) else { return Ok(None) };
        at.value.as_f64().map(Some).ok_or_else(|| at.fault("a number"))
    }

    /// `N` numbers.
    pub fn numbers<const N: usize>(self, key: &'v str) -> Result<Option<[f64; N]>, ReadError> {
        let Some(at) = self.get(key) else { return Ok(None) };
        let wrong = || at.fault(&format!("{N} numbers"));
        let list = at.value.as_array().filter(|list| list.len() == N).ok_or_else(wrong)?;
        let mut numbers = [0.0; N];
        for (number, value) in numbers.iter_mut().zip(list) {
            *number = value.as_f64().ok_or_else(wrong)?;
        }
        Ok(Some(numbers))
    }

    /// A text.
    pub fn text(self, key: &'v str) -> Result<Option<&'v str>, ReadError> {
        let Some(at) = self.get(key) else { return Ok(None) };
        at.value.as_str().map(Some).ok_or_else(|| at.fault("a string"))
    }

    /// Yes or no; no where it is absent or neither.
    pub fn flag(self, key: &'v str) -> bool {
        self.value.get(key).and_then(Value::as_bool).unwrap_or(false)
    }

    /// The `name` of this object, empty where it has none.
    pub fn name(self) -> &'v str {
        self.value.get("name").and_then(Value::as_str).unwrap_or("")
    }

    /// The path: `materials[0].emissiveFactor`.
    pub fn path(self) -> String {
        let mut path = String::new();
        for step in &self.steps[..self.depth] {
            let _ = match step {
                Step::Key(key) if path.is_empty() => path.write_str(key),
                Step::Key(key) => write!(path, ".{key}"),
                Step::Index(index) => write!(path, "[{index}]"),
            };
        }
        path
    }

    /// The path with the name in brackets: `meshes[3] ("Wheel")`.
    pub fn title(self) -> String {
        let (path, name) = (self.path(), self.name());
        if name.is_empty() { path } else { format!("{path} ({name:?})") }
    }

    /// What the file says here: `materials[0].emissiveFactor = [1, 0.5, 0]`; empty where it says nothing.
    pub fn written(self, key: &'v str) -> String {
        self.get(key).map_or_else(String::new, |at| format!("{} = {}", at.path(), at.quoted()))
    }

    /// The value, cut where it is long.
    pub fn quoted(self) -> String {
        let mut quote = Quote(Vec::new());
        let mut serializer = serde_json::Serializer::with_formatter(&mut quote, Spaced);
        let is_whole = self.value.serialize(&mut serializer).is_ok();
        let text = String::from_utf8_lossy(&quote.0).into_owned();
        if is_whole { text } else { format!("{}...", text.trim_end_matches('\u{fffd}')) }
    }

    /// An error: this value stands where something else belongs.
    pub fn fault(self, expected: &str) -> ReadError {
        ReadError::new(format!("{} is {}, expected {expected}", self.path(), self.quoted()))
    }

    /// An error: a member is absent that must be there.
    pub fn lacks(self, key: &str) -> ReadError {
        ReadError::new(format!("{} has no {key}: the file is damaged or of another version", self.path()))
    }
}

/// Takes the beginning of what is written into it.
struct Quote(Vec<u8>);

impl io::Write for Quote {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let taken = bytes.len().min(MOST_QUOTED - self.0.len());
        self.0.extend(&bytes[..taken]);
        if taken < bytes.len() { Err(io::ErrorKind::WriteZero.into()) } else { Ok(taken) }
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// JSON on one line, with blanks: `{"a": [1, 2]}`.
struct Spaced;

impl Formatter for Spaced {
    fn begin_array_value<W: io::Write + ?Sized>(&mut self, writer: &mut W, first: bool) -> io::Result<()> {
        writer.write_all(if first { b"" } else { b", " })
    }

    fn begin_object_key<W: io::Write + ?Sized>(&mut self, writer: &mut W, first: bool) -> io::Result<()> {
        writer.write_all(if first { b"" } else { b", " })
    }

    fn begin_object_value<W: io::Write + ?Sized>(&mut self, writer: &mut W) -> io::Result<()> {
        writer.write_all(b": ")
    }
}
