//! GLSL as it is written: tokens, syntax tree and types, each with its place in the source; and the same text for another
//! version of the language. Knows no OpenGL and opens no file.

pub mod ast;
mod builtins;
mod check;
mod classify;
mod constant;
mod lex;
mod nearest;
mod parse;
mod preprocess;
mod problem;
mod span;
mod translate;
mod types;
mod version;
pub mod walk;

pub use ast::{Expr, ExprKind, Item, Statement, StatementKind, Unit};
pub use check::{
    Block, Checked, Conversion, Interface, Leaf, Storage, StructInfo, Symbol, SymbolKind, Variable, check, check_pair,
    leaves,
};
pub use classify::{Class, Classified, classify};
pub use constant::{Components, evaluate};
pub use preprocess::Directive;
pub use problem::{Problem, Severity};
pub use span::{Span, TokenPlace, TokenRange};
pub use translate::{
    DRAWN_ALL_THE_SAME, Lookup, LoopBound, Rename, Translated, UniformDefault, lookups, translate, translate_bounded,
    translate_showing,
};
pub use types::{Scalar, Type};
pub use version::{Stage, Target, Version};

/// A shader that was read.
#[derive(Debug, Clone)]
pub struct Parsed {
    /// What `#version` says, where there is one.
    pub version: Option<Version>,
    /// The syntax tree.
    pub unit: Unit,
    /// What is wrong with the syntax.
    pub problems: Vec<Problem>,
    /// Where each token lies, by the indices of [`TokenRange`].
    pub tokens: Vec<TokenPlace>,
    /// All lines beginning with `#`.
    pub directives: Vec<Directive>,
    /// Bytes that no compiler looks at, because of an `#if`.
    pub inactive: Vec<(u32, u32)>,
    /// Macros the shader defines.
    pub macros: Vec<String>,
    pub(crate) macro_words: Vec<(String, u32, u32)>,
    pub(crate) source: String,
}

/// Files beyond this many bytes are cut off: places are numbers of 32 bits.
const MOST_BYTES: usize = 1 << 30;

/// Reads a shader. Whatever the text is, this returns; what is wrong stands in `problems`, in the order of the source.
#[must_use]
pub fn parse(source: &str) -> Parsed {
    let mut most = source.len().min(MOST_BYTES);
    while !source.is_char_boundary(most) {
        most -= 1;
    }
    let source = &source[..most];
    let mut problems = Vec::new();
    let raw = lex::lex(source, &mut problems);
    let found = preprocess::preprocess(raw, &mut problems);
    let version = found.version.unwrap_or(Version::NONE);
    let unit = parse::unit(&found.tokens, version, &mut problems);
    problems.sort_by_key(|p| p.span.start);
    let place = |t: &lex::Token| TokenPlace { start: t.start, end: t.end, region: t.region, span: t.span };
    Parsed {
        version: found.version,
        unit,
        problems,
        tokens: found.tokens.iter().map(place).collect(),
        directives: found.directives,
        inactive: found.inactive,
        macros: found.macros,
        macro_words: found.macro_words,
        source: source.to_string(),
    }
}

impl Parsed {
    /// The version, 1.10 where the file does not say.
    #[must_use]
    pub fn dialect(&self) -> Version {
        self.version.unwrap_or(Version::NONE)
    }

    /// The source within a span.
    #[must_use]
    pub fn text(&self, span: Span) -> &str {
        self.source.get(span.start as usize..span.end as usize).unwrap_or("")
    }

    /// The whole source.
    #[must_use]
    pub fn source(&self) -> &str {
        &self.source
    }
}
