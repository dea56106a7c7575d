//! Counts oddities that may occur everywhere in a file, and reports them once with the first place.

use crate::report::Reports;
use crate::{Diagnostic, Severity};

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
            let diagnostic = Diagnostic { severity, line: self.line, ..Diagnostic::warning(message(self)) };
            reports.push(self.line.unwrap_or(u64::MAX), diagnostic);
        }
    }

    /// Formats the count: `1 face`, `2 faces`.
    pub(crate) fn counted(&self, one: &str, many: &str) -> String {
        format!("{} {}", self.count, if self.count == 1 { one } else { many })
    }
}
