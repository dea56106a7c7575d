//! A document: references, positions in the text, diagnostics and numbers.

use super::xml::{Element, Tree};
use crate::diagnostic::Reports;
use crate::text::{LineIndex, quote};
use crate::{Diagnostic, FilePlace, Limits, ReadError, Severity, number};
use std::borrow::Cow;
use std::cell::RefCell;
use std::collections::HashMap;

pub(super) struct Document<'t> {
    pub(super) tree: &'t Tree<'t>,
    pub(super) limits: &'t Limits,
    /// Whether Blender wrote it.
    pub(super) is_from_blender: bool,
    lines: &'t LineIndex<'t>,
    /// By kind of element and `id`: some programs give the same `id` to elements of different kinds.
    ids: HashMap<(&'t str, Cow<'t, str>), Element<'t>>,
    reports: RefCell<Reports>,
}

impl<'t> Document<'t> {
    /// Indexes all elements that have an `id`.
    pub(super) fn new(tree: &'t Tree<'t>, lines: &'t LineIndex<'t>, limits: &'t Limits) -> Self {
        let tool = tree.root().path(&["asset", "contributor", "authoring_tool"]);
        let is_from_blender = tool.is_some_and(|tool| tool.text().contains("Blender"));
        let mut document = Document {
            tree,
            limits,
            is_from_blender,
            lines,
            ids: HashMap::new(),
            reports: RefCell::new(Reports::default()),
        };
        for element in tree.elements() {
            let Some(id) = element.attribute("id") else { continue };
            let earlier = *document.ids.entry((element.name(), id)).or_insert(element);
            if earlier.index != element.index {
                document.add("elements with a duplicate id", Severity::Warning, element.at(), || {
                    let id = quote(element.attribute("id").unwrap_or_default().as_bytes());
                    let line = document.line(earlier);
                    format!("the id {id} is already used by a <{}> on line {line}, which wins", element.name())
                });
            }
        }
        document
    }

    /// Returns the line where an element begins, from 1.
    pub(super) fn line(&self, element: Element<'_>) -> u64 {
        self.lines.place(element.at()).0
    }

    #[cold]
    pub(super) fn error(&self, at: usize, message: impl Into<String>) -> ReadError {
        let (line, column) = self.lines.place(at);
        ReadError::new(message).at(line, Some(column))
    }

    pub(super) fn warn(&self, at: usize, message: impl Into<String>) {
        self.report(Severity::Warning, at, message);
    }

    pub(super) fn note(&self, at: usize, message: impl Into<String>) {
        self.report(Severity::Note, at, message);
    }

    fn report(&self, severity: Severity, at: usize, message: impl Into<String>) {
        let (line, column) = self.lines.place(at);
        let diagnostic = Diagnostic { severity, ..Diagnostic::warning(message) }.at(line, Some(column));
        self.reports.borrow_mut().push(line, diagnostic);
    }

    /// Adds a diagnostic without a position, after all others.
    pub(super) fn report_at_end(&self, diagnostic: Diagnostic) {
        self.reports.borrow_mut().push(u64::MAX, diagnostic);
    }

    /// Adds a diagnostic that may occur at many places. `kind` completes "and 5 more: KIND".
    pub(super) fn add(&self, kind: &'static str, severity: Severity, at: usize, message: impl FnOnce() -> String) {
        let (line, column) = self.lines.place(at);
        let message = message();
        self.reports.borrow_mut().add(kind, severity, line, Some(column), || message);
    }

    /// Adds a warning as [`Self::add`] does, about a face that is lost.
    pub(super) fn add_loss(&self, kind: &'static str, at: usize, message: impl FnOnce() -> String) {
        let (line, column) = self.lines.place(at);
        self.reports.borrow_mut().add_loss(kind, line, Some(column), message);
    }

    /// Whether a kind has been reported so often that further ones are only counted.
    pub(super) fn is_saturated(&self, kind: &'static str) -> bool {
        self.reports.borrow().is_saturated(kind)
    }

    /// Returns the most likely reason why nothing is left, as the end of a sentence.
    pub(super) fn why_nothing(&self) -> String {
        match self.reports.borrow().first() {
            Some(Diagnostic { message, place: FilePlace { line: Some(line), .. }, .. }) => {
                format!("; line {line}: {message}")
            }
            _ => String::new(),
        }
    }

    /// Returns all diagnostics.
    pub(super) fn finish(self) -> Vec<Diagnostic> {
        self.reports.into_inner().finish()
    }

    /// Returns the element of one of these kinds with this `id`.
    pub(super) fn by_id(&self, kinds: &[&'t str], id: &str) -> Option<Element<'t>> {
        kinds.iter().find_map(|kind| self.ids.get(&(*kind, Cow::Borrowed(id)))).copied()
    }

    /// Returns the element that the attribute `name` refers to (`#id`); reports one that is missing.
    pub(super) fn target(&self, from: Element<'_>, name: &str, kinds: &[&'t str]) -> Option<Element<'t>> {
        let Some(address) = from.attribute(name) else {
            self.add(MISSING, Severity::Warning, from.at(), || format!("<{}> has no {name}", from.name()));
            return None;
        };
        self.resolve(from, &address, kinds)
    }

    /// Returns the element that a reference points at; reports one that is missing.
    pub(super) fn resolve(&self, from: Element<'_>, address: &str, kinds: &[&'t str]) -> Option<Element<'t>> {
        let address = address.trim();
        let found = match address.split_once('#') {
            Some(("", id)) => self.by_id(kinds, id).or_else(|| self.by_id(kinds, &percent_decode(id))),
            Some(_) => None,
            // Some programs omit the #.
            None => self.by_id(kinds, address),
        };
        if found.is_none() {
            self.add(MISSING, Severity::Warning, from.at(), || {
                let what = kinds.first().copied().unwrap_or_default();
                let quoted = quote(address.as_bytes());
                if address.split_once('#').is_some_and(|(file, _)| !file.is_empty()) {
                    format!("<{}> refers to the {what} {quoted} in another file, which is not read", from.name())
                } else {
                    format!("<{}> refers to the {what} {quoted}, which does not exist", from.name())
                }
            });
        }
        found
    }

    pub(super) fn numbers(&self, element: Element<'_>) -> Result<Vec<f64>, ReadError> {
        element.words().map(|(at, word)| word.parse().or_else(|_| self.odd_number(element, at, word))).collect()
    }

    /// Returns the only number in an element, which must be finite.
    pub(super) fn number(&self, element: Element<'_>) -> Result<f64, ReadError> {
        match self.finite(element)?.as_slice() {
            [value, ..] => Ok(*value),
            [] => Err(self.error(element.at(), format!("<{}> contains no number", element.name()))),
        }
    }

    /// Returns exactly `N` finite numbers.
    pub(super) fn exactly<const N: usize>(&self, element: Element<'_>) -> Result<[f64; N], ReadError> {
        let numbers = self.finite(element)?;
        numbers.get(..N).and_then(|first| first.try_into().ok()).ok_or_else(|| {
            let message = format!("<{}> contains {} numbers instead of {N}", element.name(), numbers.len());
            self.error(element.at(), message)
        })
    }

    /// Returns the numbers in an element, all of which must be finite.
    pub(super) fn finite(&self, element: Element<'_>) -> Result<Vec<f64>, ReadError> {
        let numbers = self.numbers(element)?;
        if let Some(bad) = numbers.iter().position(|value| !value.is_finite()) {
            let (at, word) = element.words().nth(bad).unwrap_or((element.at(), ""));
            let message = format!("{} of <{}> is not a finite number", quote(word.as_bytes()), element.name());
            return Err(self.error(at, message));
        }
        Ok(numbers)
    }

    /// Returns the numbers of an array.
    pub(super) fn array(&self, element: Element<'_>) -> Result<FloatArray, ReadError> {
        let mut array = FloatArray { element: element.index, values: Vec::new(), has_not_finite: false };
        for (at, word) in element.words() {
            let value = match number::f32_prefix(word.as_bytes()) {
                Some((value, length)) if length == word.len() => value,
                _ => word.parse().or_else(|_| self.odd_number(element, at, word).map(|value| value as f32))?,
            };
            array.has_not_finite |= !value.is_finite();
            array.values.push(value);
        }
        Ok(array)
    }

    /// Returns the byte where a number of an array is.
    pub(super) fn place_of_number(&self, array: &FloatArray, number: usize) -> Option<usize> {
        let element = self.tree.elements().nth(array.element as usize)?;
        element.words().nth(number).map(|(at, _)| at)
    }

    /// Reads indices, none of which may be negative. Those beyond 32 bits become `u32::MAX`.
    pub(super) fn indices(&self, element: Element<'_>, into: &mut Vec<u32>) -> Result<(), ReadError> {
        for (at, word) in element.words() {
            let (value, length) = number::integer_prefix(word.as_bytes()).unwrap_or((0, 0));
            if length == 0 || length != word.len() {
                return Err(self.no_number(element, at, word));
            }
            // Some old files write -1 for "none": it is beyond every array.
            into.push(u32::try_from(value).unwrap_or(u32::MAX));
        }
        Ok(())
    }

    /// Reads a number with a decimal comma: some programs use the system's locale.
    #[cold]
    fn odd_number(&self, element: Element<'_>, at: usize, word: &str) -> Result<f64, ReadError> {
        let with_point = word.split_once(',').and_then(|(whole, places)| {
            let is_plain = places.starts_with(|c: char| c.is_ascii_digit()) && !whole.contains('.');
            format!("{whole}.{places}").parse().ok().filter(|_| is_plain)
        });
        let value = with_point.ok_or_else(|| self.no_number(element, at, word))?;
        self.add("numbers with a decimal comma", Severity::Warning, at, || {
            format!("{} in <{}> has a decimal comma: read as {value}", quote(word.as_bytes()), element.name())
        });
        Ok(value)
    }

    #[cold]
    fn no_number(&self, element: Element<'_>, at: usize, word: &str) -> ReadError {
        self.error(at, format!("expected a number in <{}>, found {}", element.name(), quote(word.as_bytes())))
    }

    /// Returns the value of an attribute that is a count.
    pub(super) fn count(&self, element: Element<'_>, name: &str) -> Option<u64> {
        element.attribute(name)?.trim().parse().ok()
    }
}

const MISSING: &str = "unresolved references";

/// The numbers of a `float_array`.
pub(super) struct FloatArray {
    pub(super) values: Vec<f32>,
    pub(super) has_not_finite: bool,
    /// The index of its element in the tree.
    element: u32,
}

/// Decodes `%20` and other escapes, where the result is UTF-8.
pub(super) fn percent_decode(text: &str) -> String {
    let bytes = text.as_bytes();
    let mut decoded = Vec::with_capacity(bytes.len());
    let mut at = 0;
    while let Some(&byte) = bytes.get(at) {
        let code = text.get(at + 1..at + 3).filter(|_| byte == b'%').and_then(|hex| u8::from_str_radix(hex, 16).ok());
        decoded.push(code.unwrap_or(byte));
        at += if code.is_some() { 3 } else { 1 };
    }
    String::from_utf8(decoded).unwrap_or_else(|_| text.to_owned())
}

/// Returns the name of an element for messages: its `name`, or else its `id`.
pub(super) fn name_of(element: Element<'_>) -> String {
    let name = element.attribute("name").filter(|name| !name.is_empty());
    name.or_else(|| element.attribute("id")).unwrap_or_default().into_owned()
}
