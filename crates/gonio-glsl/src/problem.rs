//! Problems of a shader, and positions in its source.

use crate::Limit;

/// The severity of a [`Problem`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// A hint; every compiler accepts it.
    Hint,
    /// Some compilers accept it, others reject it or treat it differently.
    Strict,
    /// Every compiler rejects it.
    Error,
}

/// A problem with its position and advice.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Problem {
    /// Its severity.
    pub severity: Severity,
    /// The position in the source.
    pub span: Span,
    /// A stable code in kebab-case.
    pub code: &'static str,
    /// One sentence, without the line.
    pub message: String,
    /// Advice, if there is any.
    pub help: Option<String>,
    /// A misspelt name, and the one that was probably meant.
    pub renaming: Option<(String, String)>,
    /// The limit that the shader exceeds, if any. Such a shader must not be given to a driver.
    pub limit: Option<Limit>,
}

impl Problem {
    /// Creates a problem.
    pub fn new(severity: Severity, span: Span, code: &'static str, message: impl Into<String>) -> Self {
        Self { severity, span, code, message: message.into(), help: None, renaming: None, limit: None }
    }

    /// Creates a problem that every compiler rejects.
    pub fn error(span: Span, code: &'static str, message: impl Into<String>) -> Self {
        Self::new(Severity::Error, span, code, message)
    }

    /// Creates a problem for a limit that is exceeded.
    pub(crate) fn beyond(span: Span, limit: Limit) -> Self {
        Self { limit: Some(limit), ..Self::error(span, limit.code(), limit.to_string()) }
    }

    /// Creates a problem that a strict compiler rejects.
    pub fn strict(span: Span, code: &'static str, message: impl Into<String>) -> Self {
        Self::new(Severity::Strict, span, code, message)
    }

    /// Adds the name that was probably meant in place of a misspelt one.
    #[must_use]
    pub(crate) fn did_you_mean(self, misspelt: &str, near: &str) -> Self {
        let renaming = Some((misspelt.to_owned(), near.to_owned()));
        Self { renaming, ..self.with_help(format!("did you mean `{near}`?")) }
    }

    /// Adds advice.
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

/// A range of the source text, with its line and column.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct Span {
    /// First byte.
    pub start: u32,
    /// One past the last byte.
    pub end: u32,
    /// Line of the first byte, from 1.
    pub line: u32,
    /// Column of the first byte in characters, from 1.
    pub column: u32,
}

impl Span {
    /// Returns the span from the start of this one to the end of `other`.
    #[must_use]
    pub fn to(self, other: Self) -> Self {
        Self { end: self.end.max(other.end), ..self }
    }
}

/// An inclusive range of indices into [`crate::Parsed::tokens`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct TokenRange {
    /// Index of the first token.
    pub first: u32,
    /// Index of the last token.
    pub last: u32,
}

impl TokenRange {
    /// Returns the range from the start of this one to the end of `other`.
    #[must_use]
    pub fn to(self, other: Self) -> Self {
        Self { last: self.last.max(other.last), ..self }
    }
}

/// The position of a token's text. For a token from a macro it is in the `#define` or in the argument, whereas its
/// [`Span`] is the use of the macro.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TokenPlace {
    /// First byte.
    pub start: u32,
    /// One past the last byte.
    pub end: u32,
    /// 0 in the file itself, otherwise the number of the macro's use that the token came from.
    pub region: u32,
    /// The position for messages.
    pub span: Span,
}
