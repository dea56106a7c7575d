//! Collects diagnostics in file order and limits repetitions.

use crate::{Diagnostic, Severity};

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
        let moved = |diagnostic: Diagnostic| match diagnostic.file {
            // Its line refers to another file.
            Some(_) => diagnostic,
            None => Diagnostic { line: diagnostic.line.map(|line| line + lines), ..diagnostic },
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
            && self.first_loss.as_ref().is_none_or(|first| first.line > loss.line)
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
            diagnostic.line = None;
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
        if self.first_loss.as_ref().is_some_and(|first| first.line <= Some(line)) {
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
        let first = self.list.iter().min_by_key(|(line, _, d)| (*line, d.column)).map(|(_, _, d)| d);
        self.first_loss.as_ref().or(first)
    }

    /// Returns all diagnostics in file order.
    pub(crate) fn finish(mut self) -> Vec<Diagnostic> {
        // Those of another file, listed where it is referred to, stay in their order.
        self.list.sort_by_key(|(line, _, d)| (*line, d.column.filter(|_| d.file.is_none())));
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
