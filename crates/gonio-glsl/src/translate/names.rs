//! Renames old functions, and the student's names that conflict with the output version.

use std::collections::BTreeSet;

use super::{COLOUR, Rename, Translator};
use crate::ast::{Expr, ExprKind};
use crate::check::{Storage, SymbolKind};
use crate::types::words;
use crate::walk::{Visitor, walk_unit};
use crate::{Problem, Type, builtins};

impl Translator<'_> {
    pub(super) fn names(&mut self) {
        self.functions();
        self.outputs();
        self.own_names();
    }

    /// Renames `texture2D` and similar functions.
    fn functions(&mut self) {
        for (name, tokens, first) in &self.checked.function_uses {
            if let Some(new) = crate::check::modern(name) {
                self.replace_token(tokens.first, new);
            } else if name == "fma" {
                self.replace_token(tokens.first, "gonio_fma");
                for ty in ["float", "vec2", "vec3", "vec4"] {
                    self.preamble.insert(format!("{ty} gonio_fma({ty} a, {ty} b, {ty} c) {{ return a * b + c; }}"));
                }
            } else if name != "ftransform" && !builtins::exists(name, self.target.version()) {
                let message =
                    format!("the function `{name}` is not available in version {}", self.target.version().written());
                self.problems.push(Problem::strict(
                    self.parsed.tokens[tokens.first as usize].span,
                    "no-translation",
                    message,
                ));
            }
            if let (Some(Type::Opaque(sampler)), true) = (first, self.is_es())
                && (sampler.contains("1D") || sampler.contains("Rect") || sampler.contains("Buffer"))
            {
                let span = self.parsed.tokens[tokens.first as usize].span;
                let message = format!("WebGL 2 has no `{sampler}`");
                self.problems.push(Problem::strict(span, "no-translation", message));
            }
        }
    }

    /// Replaces `gl_FragColor` and `gl_FragData[..]`.
    fn outputs(&mut self) {
        struct Data(Vec<(crate::TokenRange, u32, f64)>);
        impl Visitor for Data {
            fn expression(&mut self, expr: &Expr) -> bool {
                if let ExprKind::Index { base, index } = &expr.kind
                    && matches!(&base.kind, ExprKind::Name(name) if name == "gl_FragData")
                    && let Some(value) = crate::constant::evaluate(index, &|_| None)
                {
                    self.0.push((expr.tokens, base.tokens.first, value.first().copied().unwrap_or(0.0)));
                }
                true
            }
        }
        let is_own = self.checked.symbols.iter().any(|s| matches!(&*s.name, "gl_FragColor" | "gl_FragData"));
        let is_used = |name: &str| self.checked.variables_used.contains(name);
        if is_own || !(is_used("gl_FragColor") || is_used("gl_FragData")) {
            return;
        }
        self.preamble.insert(format!("out vec4 {COLOUR};"));
        for (name, tokens) in &self.checked.variable_uses {
            if name == "gl_FragColor" {
                self.replace_token(tokens.first, COLOUR);
            }
        }
        let mut data = Data(Vec::new());
        walk_unit(&self.parsed.unit, &mut data);
        for (tokens, base, index) in data.0 {
            let name = if index == 0.0 { COLOUR.to_string() } else { format!("gonio_FragData{index}") };
            if index != 0.0 {
                self.preamble.insert(format!("vec4 {name};"));
            }
            // The index may be a macro; its bracket is not.
            match self.stretch(tokens) {
                Some((start, end)) => self.edits.replace(start, end, name),
                None => self.cannot(self.parsed.tokens[base as usize].span, "`gl_FragData` is used in a macro here"),
            }
        }
    }

    /// Renames the student's names that are reserved in the output version, or that hide a function that is called.
    fn own_names(&mut self) {
        let mut taken: BTreeSet<String> = self.checked.symbols.iter().map(|s| s.name.clone()).collect();
        taken.extend(self.parsed.macros.iter().cloned());
        let target = self.target.version();
        let mut done: Vec<(String, String)> = Vec::new();
        for (id, symbol) in self.checked.symbols.iter().enumerate() {
            let name = &symbol.name;
            let is_shared = symbol.kind == SymbolKind::Global && matches!(symbol.storage, Storage::In | Storage::Out);
            let is_function = symbol.kind == SymbolKind::Function;
            let is_builtin = builtins::exists(name, target);
            let is_bad = words::is_reserved(name, target)
                || name.contains("__")
                || name.starts_with("gl_") && builtins::variable(name, self.stage(), target).is_none_or(|f| f.is_err())
                || name.starts_with("webgl_")
                || self.checked.hiding.contains(&id)
                || self.hides_modern(symbol)
                // Both stages must choose the same name independently.
                || is_shared && is_builtin
                || is_function && is_builtin && self.is_es();
            if !is_bad || name.is_empty() {
                continue;
            }
            let new = match done.iter().find(|(from, _)| from == name) {
                Some((_, to)) => to.clone(),
                None => new_name(name, &taken),
            };
            taken.insert(new.clone());
            done.push((name.clone(), new.clone()));
            self.replace_token(symbol.declared.first, &new);
            for tokens in &symbol.uses {
                self.replace_token(tokens.first, &new);
            }
            let is_interface = is_shared || symbol.storage == Storage::Uniform;
            self.renames.push(Rename { from: name.clone(), to: new, span: symbol.span, is_interface });
        }
    }

    /// Whether a variable is called `texture` and `texture2D` becomes `texture`.
    fn hides_modern(&self, symbol: &crate::Symbol) -> bool {
        let is_variable = symbol.kind != SymbolKind::Function;
        is_variable
            && self.checked.functions_used.iter().any(|f| crate::check::modern(f).is_some_and(|new| new == symbol.name))
    }
}

fn new_name(name: &str, taken: &BTreeSet<String>) -> String {
    let mut new = name.to_string();
    while new.contains("__") {
        new = new.replace("__", "_");
    }
    if let Some(rest) = new.strip_prefix("gl_").or_else(|| new.strip_prefix("webgl_")) {
        new = if name == "gl_FragColor" { COLOUR.to_string() } else { format!("my_{rest}") };
    }
    if new == name && !new.ends_with('_') {
        new.push('_');
    }
    let mut count = 2;
    let mut found = new.clone();
    while taken.contains(&found) || found == name {
        found = format!("{}{count}", new.trim_end_matches('_'));
        count += 1;
    }
    found
}
