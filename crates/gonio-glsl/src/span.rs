//! A place in the source.

/// A stretch of the source text, and where a person finds it.
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
    /// From the start of this one to the end of `other`.
    #[must_use]
    pub fn to(self, other: Self) -> Self {
        Self { end: self.end.max(other.end), ..self }
    }
}

/// A run of tokens of [`crate::Parsed::tokens`], both ends counted in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct TokenRange {
    /// Index of the first token.
    pub first: u32,
    /// Index of the last token.
    pub last: u32,
}

impl TokenRange {
    /// From the start of this one to the end of `other`.
    #[must_use]
    pub fn to(self, other: Self) -> Self {
        Self { last: self.last.max(other.last), ..self }
    }
}

/// Where the text of a token lies. For a token out of a macro this is in the `#define` or in the argument, while its
/// [`Span`] is the place where the macro was used.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TokenPlace {
    /// First byte.
    pub start: u32,
    /// One past the last byte.
    pub end: u32,
    /// 0 in the file itself, otherwise the number of the use of a macro out of whose body the token came.
    pub region: u32,
    /// Where to point to.
    pub span: Span,
}
