//! Oddities that may be everywhere in a file without lines: counted, and told once with the first place.

use crate::report::Reports;
use crate::{Diagnostic, Severity};

/// How often something odd was met, and where first.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Tally {
    pub(crate) count: u64,
    /// In words: `face 17 points at vertex 900`.
    pub(crate) first: String,
    line: Option<u64>,
}

impl Tally {
    /// Once more; `first` is asked for the place only the first time. `line` where the file has lines.
    #[inline]
    pub(crate) fn add(&mut self, line: Option<u64>, first: impl FnOnce() -> String) {
        if self.count == 0 {
            (self.first, self.line) = (first(), line);
        }
        self.count += 1;
    }

    /// Says it, where it was met at all.
    pub(crate) fn report(&self, severity: Severity, reports: &mut Reports, message: impl FnOnce(&Self) -> String) {
        if self.count > 0 {
            let diagnostic = Diagnostic { severity, line: self.line, ..Diagnostic::warning(message(self)) };
            reports.push(self.line.unwrap_or(u64::MAX), diagnostic);
        }
    }

    /// `1 face`, `2 faces`.
    pub(crate) fn counted(&self, one: &str, many: &str) -> String {
        format!("{} {}", self.count, if self.count == 1 { one } else { many })
    }
}
