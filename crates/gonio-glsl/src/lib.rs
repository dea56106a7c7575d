//! A front end for GLSL: tokens, syntax tree and types, each with its position in the source, checks, and translation
//! to another version of the language. It uses no OpenGL and opens no files.

pub mod ast;
mod builtins;
mod check;
mod classify;
mod constant;
mod lex;
pub mod limits;
mod nearest;
mod parse;
mod preprocess;
mod problem;
mod translate;
mod types;
mod version;
pub mod walk;

pub use ast::{Expr, ExprKind, Item, Statement, StatementKind, Unit};
pub use builtins::{BuiltinVariable, builtin_variable};
pub use check::{
    Block, Checked, ImplicitConversion, Interface, Leaf, Storage, StructInfo, Symbol, SymbolKind, Variable,
    builtin_structs, check, check_pair, leaves,
};
pub use classify::{Class, Classified, classify};
pub use constant::{Components, evaluate};
pub use limits::Limit;
pub use preprocess::Directive;
pub use problem::{Problem, Severity, Span, TokenPlace, TokenRange};
pub use translate::{
    DRAWN_ALL_THE_SAME, Lookup, LoopBound, Rename, Translated, UniformDefault, lookups, translate, translate_bounded,
    translate_showing,
};
pub use types::{Scalar, Type};
pub use version::{OutputVersion, Stage, Version};

/// A parsed shader.
#[derive(Debug, Clone)]
pub struct Parsed {
    /// The `#version`, if there is one.
    pub version: Option<Version>,
    /// The syntax tree.
    pub unit: Unit,
    /// Syntax errors.
    pub problems: Vec<Problem>,
    /// The position of each token, by the indices of [`TokenRange`].
    pub tokens: Vec<TokenPlace>,
    /// All preprocessor directives.
    pub directives: Vec<Directive>,
    /// Ranges of bytes excluded by an `#if`.
    pub inactive: Vec<(u32, u32)>,
    /// The macros that the shader defines.
    pub macros: Vec<String>,
    pub(crate) macro_words: Vec<(String, u32, u32)>,
    pub(crate) source: String,
}

/// Parses a shader. This returns for any text; syntax errors are in `problems`, in source order.
#[must_use]
pub fn parse(source: &str) -> Parsed {
    let mut most = source.len().min(limits::MOST_BYTES);
    while !source.is_char_boundary(most) {
        most -= 1;
    }
    let is_cut = most < source.len();
    let source = &source[..most];
    let mut problems = Vec::new();
    let mut raw = lex::lex(source, &mut problems);
    if is_cut {
        let end = raw.last().map(|token| token.span).unwrap_or_default();
        lex::refuse(&mut raw, &mut problems, Limit::Bytes, end);
    }
    lex::check_limits(&mut raw, limits::MOST_RAW_TOKENS, &mut problems);
    let mut found = preprocess::preprocess(raw, &mut problems);
    lex::check_limits(&mut found.tokens, limits::MOST_TOKENS, &mut problems);
    if problems.iter().any(|problem| problem.limit.is_some()) {
        found.tokens.drain(..found.tokens.len().saturating_sub(1));
    }
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
    /// Returns the version, 1.10 if the file has none.
    #[must_use]
    pub fn dialect(&self) -> Version {
        self.version.unwrap_or(Version::NONE)
    }

    /// Returns the limit that the shader exceeds, if any: it must not be given to a driver then.
    #[must_use]
    pub fn refusal(&self) -> Option<&Problem> {
        self.problems.iter().find(|problem| problem.limit.is_some())
    }

    /// Returns the source within a span.
    #[must_use]
    pub fn text(&self, span: Span) -> &str {
        self.source.get(span.start as usize..span.end as usize).unwrap_or("")
    }

    /// Returns the whole source.
    #[must_use]
    pub fn source(&self) -> &str {
        &self.source
    }
}
