//! A reference into the JSON of a file: the value, and its path for messages.
//!
//! The JSON is not deserialized into structures. So a wrong value in one place affects only that place, messages can
//! name it (`accessors[3].count`), and a material can quote the file.

use crate::ReadError;
use serde::Serialize;
use serde_json::Value;
use serde_json::ser::Formatter;
use std::fmt::Write as _;
use std::io;

/// `materials[0].extensions.NAME.TEXTURE.extensions.KHR_texture_transform.offset` has 9 steps.
const MOST_STEPS: usize = 12;

/// Most bytes of a value that are quoted.
const MOST_QUOTED: usize = 100;

/// The expected value of an index, a count or a code, for messages.
const UNSIGNED: &str = "a non-negative integer";

/// A value and its path.
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
    pub fn root(value: &'v Value) -> Self {
        JsonRef { value, steps: [Step::Index(0); MOST_STEPS], depth: 0 }
    }

    fn below(self, value: &'v Value, step: Step<'v>) -> Self {
        let mut below = JsonRef { value, ..self };
        // Deeper than any value in glTF: the path remains that of the value above.
        if let Some(free) = below.steps.get_mut(self.depth) {
            *free = step;
            below.depth += 1;
        }
        below
    }

    /// Returns a member of an object; `None` if it is absent or null.
    pub fn get(self, key: &'v str) -> Option<JsonRef<'v>> {
        let value = self.value.get(key).filter(|value| !value.is_null())?;
        Some(self.below(value, Step::Key(key)))
    }

    pub fn item(self, index: usize) -> Option<JsonRef<'v>> {
        Some(self.below(self.value.as_array()?.get(index)?, Step::Index(index)))
    }

    /// Returns the elements of the array `key`; none if it is absent.
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

    /// Returns the length of the array `key`; 0 if it is absent.
    pub fn count(self, key: &str) -> usize {
        self.value.get(key).and_then(Value::as_array).map_or(0, Vec::len)
    }

    /// Returns the members of an object with their names.
    pub fn members(self) -> impl Iterator<Item = (&'v str, JsonRef<'v>)> {
        let members = self.value.as_object().into_iter().flatten();
        members.map(move |(key, value)| (key.as_str(), self.below(value, Step::Key(key))))
    }

    /// Returns the object of an extension of this object.
    pub fn extension(self, name: &'v str) -> Option<JsonRef<'v>> {
        self.get("extensions")?.get(name)
    }

    /// Returns the element of the file's array `list` that the index `key` refers to.
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

    /// Returns the value as a non-negative integer: JSON does not distinguish `1`, `1.0` and `1e0`.
    pub fn as_unsigned(self) -> Option<u64> {
        let whole = |v: f64| (v.fract() == 0.0 && (0.0..=9e15).contains(&v)).then_some(v as u64);
        self.value.as_u64().or_else(|| self.value.as_f64().and_then(whole))
    }

    /// Returns the value as an index. One that is too large becomes an index that is out of range of any array.
    pub fn as_index(self) -> Result<usize, ReadError> {
        let number = self.as_unsigned().ok_or_else(|| self.fault(UNSIGNED))?;
        Ok(usize::try_from(number).unwrap_or(usize::MAX))
    }

    /// Returns a member as a non-negative integer.
    pub fn unsigned(self, key: &'v str) -> Result<Option<u64>, ReadError> {
        let Some(at) = self.get(key) else { return Ok(None) };
        at.as_unsigned().map(Some).ok_or_else(|| at.fault(UNSIGNED))
    }

    /// Returns a member as an index or a count.
    pub fn index(self, key: &'v str) -> Result<Option<usize>, ReadError> {
        self.get(key).map(JsonRef::as_index).transpose()
    }

    pub fn number(self, key: &'v str) -> Result<Option<f64>, ReadError> {
        let Some(at) = self.get(key) else { return Ok(None) };
        at.value.as_f64().map(Some).ok_or_else(|| at.fault("a number"))
    }

    /// Returns an array of exactly `N` numbers.
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

    pub fn text(self, key: &'v str) -> Result<Option<&'v str>, ReadError> {
        let Some(at) = self.get(key) else { return Ok(None) };
        at.value.as_str().map(Some).ok_or_else(|| at.fault("a string"))
    }

    /// Returns a boolean; false if it is absent or of another type.
    pub fn flag(self, key: &'v str) -> bool {
        self.value.get(key).and_then(Value::as_bool).unwrap_or(false)
    }

    /// Returns the `name` of this object, or an empty string.
    pub fn name(self) -> &'v str {
        self.value.get("name").and_then(Value::as_str).unwrap_or("")
    }

    /// Returns the path: `materials[0].emissiveFactor`.
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

    /// Returns the path with the name in parentheses: `meshes[3] ("Wheel")`.
    pub fn title(self) -> String {
        let (path, name) = (self.path(), self.name());
        if name.is_empty() { path } else { format!("{path} ({name:?})") }
    }

    /// Returns a member as the file has it: `materials[0].emissiveFactor = [1, 0.5, 0]`; empty if it is absent.
    pub fn written(self, key: &'v str) -> String {
        self.get(key).map_or_else(String::new, |at| format!("{} = {}", at.path(), at.quoted()))
    }

    /// Returns the value as JSON, shortened if it is long.
    pub fn quoted(self) -> String {
        let mut quote = Quote(Vec::new());
        let mut serializer = serde_json::Serializer::with_formatter(&mut quote, Spaced);
        let is_whole = self.value.serialize(&mut serializer).is_ok();
        let text = String::from_utf8_lossy(&quote.0).into_owned();
        if is_whole { text } else { format!("{}...", text.trim_end_matches('\u{fffd}')) }
    }

    /// Creates an error: this value is not of the expected kind.
    pub fn fault(self, expected: &str) -> ReadError {
        ReadError::new(format!("{} is {}, expected {expected}", self.path(), self.quoted()))
    }

    /// Creates an error: a required member is missing.
    pub fn missing(self, key: &str) -> ReadError {
        ReadError::new(format!("{} has no {key}: the file is damaged or of another version", self.path()))
    }
}

/// A writer that keeps only the beginning.
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

/// Formats JSON on one line, with blanks: `{"a": [1, 2]}`.
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
