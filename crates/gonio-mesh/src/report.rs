//! Collects diagnostics: in the order of the file, and not the same one a million times.

use crate::{Diagnostic, Severity};

/// How many of one kind are told one by one.
const MOST_OF_A_KIND: u64 = 20;

/// Diagnostics of one file on their way into a model.
#[derive(Default)]
pub(crate) struct Reports {
    /// With the line to sort by.
    list: Vec<(u64, Diagnostic)>,
    /// The first by line that cost a face.
    first_loss: Option<Diagnostic>,
    /// Kind, how many, the severity.
    kinds: Vec<(&'static str, u64, Severity)>,
}

impl Reports {
    /// Something that may be odd at many places. `kind` is a phrase for "and 5 more: KIND".
    pub(crate) fn add(
        &mut self,
        kind: &'static str,
        severity: Severity,
        line: u64,
        column: Option<u64>,
        message: impl FnOnce() -> String,
    ) {
        let index = self.kinds.iter().position(|k| k.0 == kind).unwrap_or_else(|| {
            self.kinds.push((kind, 0, severity));
            self.kinds.len() - 1
        });
        self.kinds[index].1 += 1;
        if self.kinds[index].1 <= MOST_OF_A_KIND {
            self.list.push((line, Diagnostic { severity, ..Diagnostic::warning(message()) }.at(line, column)));
        }
    }

    /// A diagnostic as it stands, to be listed where `line` would be.
    pub(crate) fn push(&mut self, line: u64, diagnostic: Diagnostic) {
        self.list.push((line, diagnostic));
    }

    /// A warning at a line.
    pub(crate) fn warning(&mut self, line: u64, message: impl Into<String>) {
        self.push(line, Diagnostic::warning(message).at(line, None));
    }

    /// A note at a line.
    pub(crate) fn note(&mut self, line: u64, message: impl Into<String>) {
        self.push(line, Diagnostic::note(message).at(line, None));
    }

    /// As [`Self::add`] a warning, about a face that is lost by it.
    pub(crate) fn add_loss(
        &mut self,
        kind: &'static str,
        line: u64,
        column: Option<u64>,
        message: impl FnOnce() -> String,
    ) {
        let message = message();
        if self.first_loss.as_ref().is_none_or(|first| first.line > Some(line)) {
            self.first_loss = Some(Diagnostic::warning(message.clone()).at(line, column));
        }
        self.add(kind, Severity::Warning, line, column, || message);
    }

    /// What most likely explains that nothing is left: the first face lost, or the first diagnostic.
    pub(crate) fn first(&self) -> Option<&Diagnostic> {
        let first = self.list.iter().min_by_key(|(line, d)| (*line, d.column)).map(|(_, d)| d);
        self.first_loss.as_ref().or(first)
    }

    /// All of them, in the order of the file.
    pub(crate) fn finish(mut self) -> Vec<Diagnostic> {
        // Those of another file, listed where it is named, stay in their order.
        self.list.sort_by_key(|(line, d)| (*line, d.column.filter(|_| d.file.is_none())));
        let mut list: Vec<Diagnostic> = self.list.into_iter().map(|(_, d)| d).collect();
        for (kind, count, severity) in self.kinds {
            if count > MOST_OF_A_KIND {
                let message = format!("and {} more: {kind}", count - MOST_OF_A_KIND);
                list.push(Diagnostic { severity, ..Diagnostic::warning(message) });
            }
        }
        list
    }
}
