//! Diagnostics of a file: errors, which end the reading, and warnings and notes, which do not. `Reports` collects them in
//! file order and limits repetitions.

use serde::Serialize;
use std::fmt;

/// The severity of a diagnostic.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// The file was read as intended.
    Note,
    /// Reading continued, but part of the file is lost or guessed.
    Warning,
}

/// A place in a file; all parts may be unknown.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct FilePlace {
    /// The file as the user knows it; set by the code that opened it.
    pub file: Option<String>,
    /// The line, from 1.
    pub line: Option<u64>,
    /// The column in bytes, from 1.
    pub column: Option<u64>,
}

impl FilePlace {
    /// Creates a place from a line, if it is known.
    pub fn on_line(line: Option<u64>) -> Self {
        FilePlace { line, ..FilePlace::default() }
    }

    /// Returns the place after `lines` more lines.
    pub(crate) fn moved_by(self, lines: u64) -> Self {
        FilePlace { line: self.line.map(|line| line + lines), ..self }
    }
}

/// The start of a message: `FILE:LINE:COLUMN: `, without unknown parts; nothing if neither file nor line is known.
impl fmt::Display for FilePlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(file) = &self.file {
            write!(f, "{file}:")?;
        }
        if let Some(line) = self.line {
            write!(f, "{line}:")?;
        }
        if let (Some(_), Some(column)) = (self.line, self.column) {
            write!(f, "{column}:")?;
        }
        if self.file.is_some() || self.line.is_some() { f.write_str(" ") } else { Ok(()) }
    }
}

/// A warning or note about a file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Diagnostic {
    /// Its severity.
    pub severity: Severity,
    /// One sentence, without position and final full stop.
    pub message: String,
    /// The place in a file.
    #[serde(flatten)]
    pub place: FilePlace,
    /// The cause, where a setting of the program can remove it.
    #[serde(skip)]
    pub cause: Option<Cause>,
}

impl Diagnostic {
    /// Creates a warning without a position.
    pub fn warning(message: impl Into<String>) -> Self {
        Diagnostic { severity: Severity::Warning, message: message.into(), place: FilePlace::default(), cause: None }
    }

    /// Creates a note without a position.
    pub fn note(message: impl Into<String>) -> Self {
        Diagnostic { severity: Severity::Note, ..Self::warning(message) }
    }

    /// Sets a cause that a setting can remove.
    pub fn caused_by(mut self, cause: Cause) -> Self {
        self.cause = Some(cause);
        self
    }

    /// Sets the line, and perhaps the column.
    pub fn at(mut self, line: u64, column: Option<u64>) -> Self {
        self.place.line = Some(line);
        self.place.column = column;
        self
    }

    /// Sets the file, unless it is already set.
    pub fn in_file(mut self, file: &str) -> Self {
        self.place.file.get_or_insert_with(|| file.to_owned());
        self
    }
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.place.fmt(f)?;
        let severity = match self.severity {
            Severity::Note => "note",
            Severity::Warning => "warning",
        };
        write!(f, "{severity}: {}", self.message)
    }
}

/// A cause of an error or a warning that a setting of the program can remove. Messages do not mention the setting; a
/// program that has one adds a hint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cause {
    /// The file needs more memory than [`Limits::max_bytes`](crate::Limits::max_bytes).
    MemoryLimit,
    /// The file is outside the folders that may be read.
    Sandbox,
    /// The file was named as a model, and it is an environment.
    EnvironmentAsModel,
    /// A scene needs an environment and has none.
    NoEnvironment,
    /// The layout of an environment's faces was guessed.
    GuessedLayout,
    /// A panorama was made into a coarser cubemap than it is.
    CoarseEnvironment,
}

/// The reason why a file could not be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ReadError {
    /// One sentence: what is wrong and what to do.
    pub message: String,
    /// The place in a file.
    pub place: FilePlace,
    /// The cause, if a setting can remove it.
    pub cause: Option<Cause>,
}

impl ReadError {
    /// Creates an error without a position.
    pub fn new(message: impl Into<String>) -> Self {
        ReadError { message: message.into(), place: FilePlace::default(), cause: None }
    }

    /// Sets a cause that a setting can remove.
    pub fn caused_by(mut self, cause: Cause) -> Self {
        self.cause = Some(cause);
        self
    }

    /// Sets the line, and perhaps the column.
    pub fn at(mut self, line: u64, column: Option<u64>) -> Self {
        self.place.line = Some(line);
        self.place.column = column;
        self
    }

    /// Sets the file, unless it is already set.
    pub fn in_file(mut self, file: &str) -> Self {
        self.place.file.get_or_insert_with(|| file.to_owned());
        self
    }
}

impl fmt::Display for ReadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.place.fmt(f)?;
        f.write_str(&self.message)
    }
}

impl std::error::Error for ReadError {}

/// Most diagnostics of one kind that are listed.
const MOST_OF_A_KIND: u64 = 20;

/// Diagnostics of a file.
#[derive(Default)]
pub(crate) struct Reports {
    /// Each with the line to sort by, and its kind if it has one.
    list: Vec<(u64, Option<&'static str>, Diagnostic)>,
    /// The first diagnostic by line that is about a lost face.
    first_loss: Option<Diagnostic>,
    /// Kind, count, severity.
    kinds: Vec<(&'static str, u64, Severity)>,
}

impl Reports {
    /// Adds a diagnostic that may occur at many places. `kind` completes "and 5 more: KIND".
    pub(crate) fn add(
        &mut self,
        kind: &'static str,
        severity: Severity,
        line: u64,
        column: Option<u64>,
        message: impl FnOnce() -> String,
    ) {
        if self.count(kind, 1, severity) <= MOST_OF_A_KIND {
            let diagnostic = Diagnostic { severity, ..Diagnostic::warning(message()) }.at(line, column);
            self.list.push((line, Some(kind), diagnostic));
        }
    }

    /// Counts more of a kind; returns the new count.
    fn count(&mut self, kind: &'static str, more: u64, severity: Severity) -> u64 {
        let index = self.kinds.iter().position(|k| k.0 == kind).unwrap_or_else(|| {
            self.kinds.push((kind, 0, severity));
            self.kinds.len() - 1
        });
        self.kinds[index].1 += more;
        self.kinds[index].1
    }

    /// Appends the diagnostics of the next part of the file, whose lines were counted from its start; `lines` precede
    /// it. The result is the same as if both parts had been reported here.
    pub(crate) fn append(&mut self, other: Reports, lines: u64) {
        let moved = |diagnostic: Diagnostic| match diagnostic.place.file {
            // Its line refers to another file.
            Some(_) => diagnostic,
            None => Diagnostic { place: diagnostic.place.moved_by(lines), ..diagnostic },
        };
        let mut room: Vec<(&str, u64)> = Vec::with_capacity(other.kinds.len());
        for (kind, count, severity) in other.kinds {
            let before = self.count(kind, count, severity) - count;
            room.push((kind, MOST_OF_A_KIND.saturating_sub(before)));
        }
        for (line, kind, diagnostic) in other.list {
            if let Some((_, room)) = room.iter_mut().find(|(k, _)| Some(*k) == kind) {
                if *room == 0 {
                    continue;
                }
                *room -= 1;
            }
            self.list.push((line.saturating_add(lines), kind, moved(diagnostic)));
        }
        if let Some(loss) = other.first_loss.map(moved)
            && self.first_loss.as_ref().is_none_or(|first| first.place.line > loss.place.line)
        {
            self.first_loss = Some(loss);
        }
    }

    /// Like [`Self::add`], for formats without lines: in the order of the calls.
    pub(crate) fn add_without_line(
        &mut self,
        kind: &'static str,
        severity: Severity,
        message: impl FnOnce() -> String,
    ) {
        let own_count = self.list.len();
        self.add(kind, severity, 0, None, message);
        for (_, _, diagnostic) in &mut self.list[own_count..] {
            diagnostic.place.line = None;
        }
    }

    /// Adds a diagnostic unchanged, listed at `line`.
    pub(crate) fn push(&mut self, line: u64, diagnostic: Diagnostic) {
        self.list.push((line, None, diagnostic));
    }

    pub(crate) fn warning(&mut self, line: u64, message: impl Into<String>) {
        self.push(line, Diagnostic::warning(message).at(line, None));
    }

    pub(crate) fn note(&mut self, line: u64, message: impl Into<String>) {
        self.push(line, Diagnostic::note(message).at(line, None));
    }

    /// Adds a warning as [`Self::add`] does, about a face that is lost.
    pub(crate) fn add_loss(
        &mut self,
        kind: &'static str,
        line: u64,
        column: Option<u64>,
        message: impl FnOnce() -> String,
    ) {
        if self.first_loss.as_ref().is_some_and(|first| first.place.line <= Some(line)) {
            return self.add(kind, Severity::Warning, line, column, message);
        }
        let message = message();
        self.first_loss = Some(Diagnostic::warning(message.clone()).at(line, column));
        self.add(kind, Severity::Warning, line, column, || message);
    }

    /// Whether a kind has been reported so often that further ones are only counted.
    pub(crate) fn is_saturated(&self, kind: &'static str) -> bool {
        self.kinds.iter().any(|(known, count, _)| *known == kind && *count >= MOST_OF_A_KIND)
    }

    /// Returns the most likely reason why nothing is left: the first lost face, or the first diagnostic.
    pub(crate) fn first(&self) -> Option<&Diagnostic> {
        let first = self.list.iter().min_by_key(|(line, _, d)| (*line, d.place.column)).map(|(_, _, d)| d);
        self.first_loss.as_ref().or(first)
    }

    /// Returns all diagnostics in file order.
    pub(crate) fn finish(mut self) -> Vec<Diagnostic> {
        // Those of another file, listed where it is referred to, stay in their order.
        self.list.sort_by_key(|(line, _, d)| (*line, d.place.column.filter(|_| d.place.file.is_none())));
        let mut list: Vec<Diagnostic> = self.list.into_iter().map(|(_, _, d)| d).collect();
        for (kind, count, severity) in self.kinds {
            if count > MOST_OF_A_KIND {
                let message = format!("and {} more: {kind}", count - MOST_OF_A_KIND);
                list.push(Diagnostic { severity, ..Diagnostic::warning(message) });
            }
        }
        list
    }
}

/// The number of occurrences of an oddity, and the first one.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Tally {
    pub(crate) count: u64,
    /// For example: `face 17 points at vertex 900`.
    pub(crate) first: String,
    line: Option<u64>,
}

impl Tally {
    /// Counts one occurrence; `first` is only called for the first one. `line` is its line, if the file has lines.
    #[inline]
    pub(crate) fn add(&mut self, line: Option<u64>, first: impl FnOnce() -> String) {
        if self.count == 0 {
            (self.first, self.line) = (first(), line);
        }
        self.count += 1;
    }

    /// Reports the oddity if it occurred.
    pub(crate) fn report(&self, severity: Severity, reports: &mut Reports, message: impl FnOnce(&Self) -> String) {
        if self.count > 0 {
            let diagnostic =
                Diagnostic { severity, place: FilePlace::on_line(self.line), ..Diagnostic::warning(message(self)) };
            reports.push(self.line.unwrap_or(u64::MAX), diagnostic);
        }
    }

    /// Formats the count: `1 face`, `2 faces`.
    pub(crate) fn counted(&self, one: &str, many: &str) -> String {
        format!("{} {}", self.count, if self.count == 1 { one } else { many })
    }
}
