//! Rules for the whole shader, most of which Mesa does not enforce.

use std::collections::HashSet;

use super::{Checker, Storage, SymbolKind};
use crate::ast::{Declaration, Expr, ExprKind, Item, Literal, Unit};
use crate::walk::{Visitor, walk_unit};
use crate::{Problem, Scalar, Stage, Type};

pub(super) fn whole(checker: &mut Checker<'_>, unit: &Unit) {
    main(checker);
    stray_semicolons(checker, unit);
    float_suffixes(checker, unit);
    precision(checker, unit);
    recursion(checker);
    outputs(checker);
}

fn main(checker: &mut Checker<'_>) {
    let list = checker.functions.get("main").cloned().unwrap_or_default();
    let end = checker.parsed.tokens.last().map(|t| t.span).unwrap_or_default();
    let Some(found) = list.iter().find(|f| f.has_body) else {
        let problem = Problem::error(end, "missing-main", "this shader has no `void main()`");
        checker.unknown(problem);
        return;
    };
    if !found.params.is_empty() || found.returns.as_ref().is_some_and(|t| *t != Type::Void) {
        checker.error(found.span, "wrong-main", "`main` must be declared as `void main()`");
    }
}

/// Reports stray semicolons, which are allowed from 4.60 on (GLSL 4.60, chapter 9).
fn stray_semicolons(checker: &mut Checker<'_>, unit: &Unit) {
    if checker.version.is_at_least(460, 320) {
        return;
    }
    for item in &unit.items {
        if let Item::Empty(span) = item {
            let problem = Problem::strict(*span, "stray-semicolon", "unexpected `;` outside of functions");
            checker.problems.push(problem.with_help("remove it"));
        }
    }
}

/// Reports suffixes such as in `1.0f`, which exist from 1.20 on, and in ES from 3.00 on.
fn float_suffixes(checker: &mut Checker<'_>, unit: &Unit) {
    struct Suffixes<'c, 'p> {
        checker: &'c mut Checker<'p>,
    }
    impl Visitor for Suffixes<'_, '_> {
        fn expression(&mut self, expr: &Expr) -> bool {
            if let ExprKind::Literal(Literal::Float(_)) = expr.kind {
                let place = self.checker.parsed.tokens[expr.tokens.first as usize];
                let text = self.checker.parsed.source.get(place.start as usize..place.end as usize).unwrap_or("");
                if text.ends_with(['f', 'F']) && !text.starts_with('(') {
                    let message =
                        format!("`{text}`: version {} does not allow the suffix `f`", self.checker.version.written());
                    let problem = Problem::strict(expr.span, "float-suffix", message);
                    self.checker.problems.push(problem.with_help("remove the `f`"));
                }
            }
            true
        }
    }
    if !checker.version.is_at_least(120, 300) {
        walk_unit(unit, &mut Suffixes { checker });
    }
}

/// Reports a missing precision: in OpenGL ES a fragment shader has no default one for floats (GLSL ES 3.00, section
/// 4.5.4).
fn precision(checker: &mut Checker<'_>, unit: &Unit) {
    if !checker.version.es || checker.stage != Stage::Fragment {
        return;
    }
    struct First(Option<crate::Span>);
    impl Visitor for First {
        fn declaration(&mut self, declaration: &Declaration) -> bool {
            let is_float = Type::named(&declaration.ty.name).and_then(|t| t.scalar()) == Some(Scalar::Float);
            let is_written = declaration.qualifiers.iter().any(|q| matches!(&*q.word, "highp" | "mediump" | "lowp"));
            if is_float && !is_written && self.0.is_none() {
                self.0 = Some(declaration.ty.span);
            }
            true
        }
    }
    let is_written = unit.items.iter().any(|i| matches!(i, Item::Precision(p) if p.ty.name == "float"));
    let mut first = First(None);
    walk_unit(unit, &mut first);
    if let (Some(span), false) = (first.0, is_written) {
        let problem = Problem::strict(span, "missing-precision", "no default precision for `float`");
        checker.problems.push(problem.with_help("add `precision highp float;` near the top"));
    }
}

/// Reports recursion, direct or indirect (GLSL 4.60, section 6.1).
fn recursion(checker: &mut Checker<'_>) {
    let mut found = Vec::new();
    for (name, list) in &checker.functions {
        for (index, info) in list.iter().enumerate() {
            let mut seen = HashSet::new();
            let mut open: Vec<_> = info.calls.clone();
            while let Some(call) = open.pop() {
                if call == (name.clone(), index) {
                    found.push((info.span, name.clone()));
                    break;
                }
                if !seen.insert(call.clone()) {
                    continue;
                }
                if let Some(next) = checker.functions.get(&call.0).and_then(|l| l.get(call.1)) {
                    open.extend(next.calls.iter().cloned());
                }
            }
        }
    }
    for (span, name) in found {
        checker.strict(span, "recursion", format!("`{name}` calls itself, which GLSL does not allow"));
    }
    let mut missing = Vec::new();
    for (name, info) in checker.functions.iter().flat_map(|(n, l)| l.iter().map(move |i| (n, i))) {
        if !info.has_body && checker.symbols[info.symbol].is_read {
            missing.push((info.span, name.clone()));
        }
    }
    for (span, name) in missing {
        let message = format!("`{name}` is called, but only declared: its body is missing");
        checker.unknown(Problem::error(span, "missing-body", message));
    }
}

/// Reports outputs that are never written, which are undefined.
fn outputs(checker: &mut Checker<'_>) {
    if checker.has_syntax_errors {
        return;
    }
    let mut found = Vec::new();
    for symbol in &checker.symbols {
        if symbol.kind == SymbolKind::Global && symbol.storage == Storage::Out && !symbol.is_written {
            found.push((symbol.span, symbol.name.clone()));
        }
    }
    if checker.stage == Stage::Vertex && !checker.variable_uses.iter().any(|(name, _)| name == "gl_Position") {
        let is_own = checker.symbols.iter().any(|s| s.name == "gl_Position");
        if let Some(main) = checker.functions.get("main").and_then(|l| l.first()).filter(|_| !is_own) {
            found.push((main.span, "gl_Position".into()));
        }
    }
    for (span, name) in found {
        checker.strict(span, "output-not-written", format!("`{name}` is never assigned a value"));
    }
}
