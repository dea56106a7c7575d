//! Positions in the source.

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
