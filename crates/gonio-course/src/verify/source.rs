//! Edits of shaders at the places of their syntax trees.

use gonio_glsl::walk::{Visitor, walk_unit};
use gonio_glsl::{Checked, Expr, Parsed, Stage};
use std::ops::Range;

/// A shader with its syntax tree and types.
pub(super) struct Source<'a> {
    pub text: &'a str,
    pub parsed: Parsed,
    pub checked: Checked,
}

impl<'a> Source<'a> {
    pub fn new(stage: Stage, text: &'a str) -> Self {
        let mut parsed = gonio_glsl::parse(text);
        let checked = gonio_glsl::check(&mut parsed, stage);
        Source { text, parsed, checked }
    }

    /// The text at bytes of the source.
    pub fn slice(&self, range: Range<usize>) -> &'a str {
        self.text.get(range).unwrap_or_default()
    }

    pub fn of(&self, expr: &Expr) -> &'a str {
        self.slice(range(expr))
    }

    /// The expressions that are no part of another one.
    pub fn roots(&self) -> Vec<Expr> {
        struct Roots(Vec<Expr>);
        impl Visitor for Roots {
            fn expression(&mut self, expr: &Expr) -> bool {
                self.0.push(expr.clone());
                false
            }
        }
        let mut roots = Roots(Vec::new());
        walk_unit(&self.parsed.unit, &mut roots);
        roots.0
    }

    /// All expressions, outer ones first.
    pub fn expressions(&self) -> Vec<Expr> {
        struct All(Vec<Expr>);
        impl Visitor for All {
            fn expression(&mut self, expr: &Expr) -> bool {
                self.0.push(expr.clone());
                true
            }
        }
        let mut all = All(Vec::new());
        walk_unit(&self.parsed.unit, &mut all);
        all.0
    }
}

/// The bytes of an expression, with the parentheses around it.
pub(super) fn range(expr: &Expr) -> Range<usize> {
    expr.span.start as usize..expr.span.end as usize
}

/// The text with pieces replaced. Overlapping pieces are left as they are, except the first.
pub(super) fn replaced(text: &str, mut edits: Vec<(Range<usize>, String)>) -> String {
    edits.sort_by_key(|(range, _)| range.start);
    let (mut result, mut at) = (String::with_capacity(text.len()), 0);
    for (range, new) in edits {
        let Some(before) = text.get(at..range.start).filter(|_| range.start >= at && range.end <= text.len()) else {
            continue;
        };
        result.push_str(before);
        result.push_str(&new);
        at = range.end;
    }
    result.push_str(text.get(at..).unwrap_or_default());
    result
}
