//! What is wrong with a shader, in one sentence.

use crate::{Limit, Span};

/// How bad a [`Problem`] is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// Worth a look; every compiler takes it.
    Hint,
    /// Some compilers take it, others refuse it or treat it otherwise.
    Strict,
    /// Every compiler refuses it.
    Error,
}

/// One thing that is wrong, where, and what to do.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Problem {
    /// How bad it is.
    pub severity: Severity,
    /// Where it is.
    pub span: Span,
    /// A stable kebab-case word.
    pub code: &'static str,
    /// One sentence, without the line.
    pub message: String,
    /// What to do, where that is known.
    pub help: Option<String>,
    /// The limit that the shader exceeds, where it does. Such a shader must not be given to a driver.
    pub limit: Option<Limit>,
}

impl Problem {
    /// A problem of any severity.
    pub fn new(severity: Severity, span: Span, code: &'static str, message: impl Into<String>) -> Self {
        Self { severity, span, code, message: message.into(), help: None, limit: None }
    }

    /// What every compiler refuses.
    pub fn error(span: Span, code: &'static str, message: impl Into<String>) -> Self {
        Self::new(Severity::Error, span, code, message)
    }

    /// A limit that the shader exceeds here.
    pub(crate) fn beyond(span: Span, limit: Limit) -> Self {
        Self { limit: Some(limit), ..Self::error(span, limit.code(), limit.to_string()) }
    }

    /// What a strict compiler refuses.
    pub fn strict(span: Span, code: &'static str, message: impl Into<String>) -> Self {
        Self::new(Severity::Strict, span, code, message)
    }

    /// The same with advice.
    #[must_use]
    pub fn with_help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }
}

impl std::fmt::Display for Problem {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "line {}: {}", self.span.line, self.message)?;
        match &self.help {
            Some(help) => write!(f, "; {help}"),
            None => Ok(()),
        }
    }
}
