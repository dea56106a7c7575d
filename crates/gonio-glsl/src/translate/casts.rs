//! Writes out implicit conversions, converts initializer lists to constructors, and moves initializers of globals to
//! `main` where ES requires it.

use super::Translator;
use crate::ast::Item;
use crate::{ImplicitConversion, Problem, Scalar};

impl Translator<'_> {
    pub(super) fn casts(&mut self) {
        for conversion in &self.checked.conversions {
            if self.needs(conversion) {
                self.cast(conversion);
            }
        }
        for (tokens, ty) in &self.checked.lists {
            let Some((start, end)) = self.stretch(*tokens) else { continue };
            self.edits.replace(start, start + 1, format!("{ty}("));
            self.edits.replace(end - 1, end, ")");
        }
    }

    /// Whether the output version does not convert implicitly. Before 1.30 all functions took floats, so an `int` there
    /// means a `float`, which later versions would not assume.
    fn needs(&self, conversion: &ImplicitConversion) -> bool {
        match conversion.to.scalar() {
            // Doubles become floats.
            Some(Scalar::Float | Scalar::Double) => {
                let is_from_float = conversion.from.scalar() == Some(Scalar::Float);
                !is_from_float && (self.is_es() || !self.parsed.dialect().is_at_least(130, 0))
            }
            _ => true,
        }
    }

    fn cast(&mut self, conversion: &ImplicitConversion) {
        let ty = match conversion.to.scalar() {
            Some(Scalar::Double) => conversion.to.with_scalar(Scalar::Float),
            _ => conversion.to.clone(),
        };
        let Some((start, end)) = self.stretch(conversion.tokens) else {
            let message = "a macro mixes `int` and `float` here";
            self.problems.push(Problem::strict(conversion.span, "no-translation", message));
            return;
        };
        let text = self.parsed.source.get(start as usize..end as usize).unwrap_or("");
        let is_plain = conversion.is_literal && text.chars().all(|c| c.is_ascii_digit());
        if is_plain && matches!(ty.scalar(), Some(Scalar::Float)) && !(text.starts_with('0') && text.len() > 1) {
            self.edits.replace(start, end, format!("{text}.0"));
        } else {
            self.edits.wrap(start, end, &format!("{ty}("));
        }
    }

    /// Replaces swizzles of scalars, `s.xxx`, which need 4.20, by `vec3(s)`.
    pub(super) fn scalar_components(&mut self) {
        struct Found(Vec<(crate::TokenRange, crate::TokenRange, usize)>);
        impl crate::walk::Visitor for Found {
            fn expression(&mut self, expr: &crate::Expr) -> bool {
                if let crate::ExprKind::Field { base, name, .. } = &expr.kind
                    && matches!(base.ty, Some(crate::Type::Scalar(_)))
                {
                    self.0.push((expr.tokens, base.tokens, name.len()));
                }
                true
            }
        }
        let mut found = Found(Vec::new());
        crate::walk::walk_unit(&self.parsed.unit, &mut found);
        for (whole, base, count) in found.0 {
            let (Some((_, end)), Some((start, middle))) = (self.stretch(whole), self.stretch(base)) else { continue };
            if count > 1 {
                self.edits.wrap(start, middle, &format!("vec{count}("));
            }
            self.edits.blank(&self.parsed.source, middle, end);
        }
    }

    /// Moves a global's initializer that is not constant to `main`, as ES requires.
    pub(super) fn move_to_main(&mut self, name: u32, equals: u32, value: crate::TokenRange) {
        let tokens = crate::TokenRange { first: equals, last: value.last };
        let (Some((start, end)), Some((from, to))) = (self.stretch(tokens), self.stretch(value)) else {
            self.cannot(self.parsed.tokens[name as usize].span, "this value comes from a macro");
            return;
        };
        let place = self.parsed.tokens[name as usize];
        let name = self.edits.apply(&self.parsed.source, place.start, place.end);
        let text = self.edits.apply(&self.parsed.source, from, to);
        // On one line a comment would extend to the rest.
        let lines: Vec<&str> = text.lines().map(|l| l.split("//").next().unwrap_or("").trim()).collect();
        self.first_in_main.push_str(&format!(" {name} = {};", lines.join(" ")));
        self.edits.blank(&self.parsed.source, start, end);
    }

    pub(super) fn main(&mut self) {
        if self.first_in_main.is_empty() {
            return;
        }
        for item in &self.parsed.unit.items {
            if let Item::Function(function) = item
                && function.name == "main"
                && function.body.is_some()
                && let Some((_, end)) = self.stretch(function.open)
            {
                self.edits.append(end, &self.first_in_main);
                return;
            }
        }
    }
}
