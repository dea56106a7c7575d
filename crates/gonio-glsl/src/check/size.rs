//! Measures a shader as drivers see it: arrays and structs by their components, functions with everything they call.

use std::collections::HashMap;

use super::{Checker, Storage, Symbol, SymbolKind};
use crate::ast::{Expr, ExprKind};
use crate::limits::{
    MOST_ALL_COMPONENTS, MOST_CALLS_NESTED, MOST_COMPONENTS, MOST_FUNCTIONS, MOST_INLINED, MOST_INTERFACE_COMPONENTS,
    MOST_LOOPS_NESTED, MOST_OVERLOADS, MOST_STRUCTS_NESTED, MOST_VARIABLES,
};
use crate::walk::{Visitor, walk_expression};
use crate::{Limit, Problem, Span, Type};

/// A struct's components, and its depth of nested structs.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct StructSize {
    components: u64,
    nested: usize,
}

/// The cost of a function by itself, and its calls.
#[derive(Debug, Clone, Default)]
pub(super) struct Cost {
    expressions: u64,
    loops: u32,
    /// The called function, by name and overload index, and the loops around the call.
    calls: Vec<((String, usize), u32)>,
}

/// The cost including all called functions.
#[derive(Debug, Clone, Copy)]
struct Total {
    expressions: u64,
    loops: u32,
    calls: u32,
}

impl Checker<'_> {
    /// Reports that a limit is exceeded; only the first one is reported.
    pub(super) fn beyond(&mut self, span: Span, limit: Limit) {
        if !self.is_beyond {
            self.is_beyond = true;
            self.problems.push(Problem::beyond(span, limit));
        }
    }

    /// Returns the number of components of a type; arrays of unknown size count as one element.
    fn components(&self, ty: &Type) -> u64 {
        match ty {
            Type::Void => 0,
            Type::Opaque(_) => 1,
            Type::Struct(name) => self.struct_sizes.get(name).map_or(1, |size| size.components),
            Type::Array(of, count) => self.components(of).saturating_mul(u64::from(count.unwrap_or(1))),
            _ => u64::from(ty.components().unwrap_or(1)),
        }
    }

    /// Checks a type that the shader declares or constructs against the limits.
    pub(super) fn check_type(&mut self, ty: &Type, span: Span) {
        if self.components(ty) > MOST_COMPONENTS {
            self.beyond(span, Limit::Components);
        }
    }

    /// Checks an array size against the limits: known sizes, and constants that cannot be evaluated.
    pub(super) fn check_size(&mut self, size: &Expr, value: Option<f64>) {
        match value {
            Some(value) if value > MOST_COMPONENTS as f64 || value.is_nan() => {
                self.beyond(size.span, Limit::Components);
            }
            None if size.ty.is_some() && self.is_constant(size) && !names_limit(size) => {
                self.beyond(size.span, Limit::UnknownSize);
            }
            _ => {}
        }
    }

    /// Checks a struct against the limits, and records its size.
    pub(super) fn check_struct(&mut self, name: &str, members: &[(String, Option<Type>)], span: Span) {
        let mut size = StructSize { components: 0, nested: 1 };
        for ty in members.iter().filter_map(|(_, ty)| ty.as_ref()) {
            size.components = size.components.saturating_add(self.components(ty));
            if let Type::Struct(of) = ty.innermost() {
                let below = self.struct_sizes.get(of).map_or(0, |below| below.nested);
                size.nested = size.nested.max(below + 1);
            }
        }
        if size.components > MOST_COMPONENTS {
            self.beyond(span, Limit::Components);
        } else if size.nested > MOST_STRUCTS_NESTED {
            self.beyond(span, Limit::StructsNested);
        } else if members.len() > MOST_VARIABLES {
            self.beyond(span, Limit::Variables);
        }
        let known = self.struct_sizes.entry(name.to_string()).or_default();
        // Of several structs with one name, in functions, the largest counts.
        known.components = known.components.max(size.components);
        known.nested = known.nested.max(size.nested);
    }

    /// Checks a new variable against the limits, and all variables together.
    pub(super) fn check_variable(&mut self, symbol: &Symbol) {
        let Some(ty) = &symbol.ty else { return };
        let components = self.components(ty);
        self.all_components = self.all_components.saturating_add(components);
        let is_global = symbol.kind == SymbolKind::Global;
        self.globals += usize::from(is_global);
        let is_between = is_global && matches!(symbol.storage, Storage::In | Storage::Out);
        if components > MOST_COMPONENTS {
            self.beyond(symbol.span, Limit::Components);
        } else if is_between && components > MOST_INTERFACE_COMPONENTS {
            self.beyond(symbol.span, Limit::InterfaceComponents);
        } else if self.all_components > MOST_ALL_COMPONENTS {
            self.beyond(symbol.span, Limit::AllComponents);
        } else if self.globals > MOST_VARIABLES {
            self.beyond(symbol.span, Limit::Variables);
        }
    }

    /// Counts a call of the shader's own function.
    pub(super) fn count_call(&mut self, name: &str, index: usize) {
        self.cost.calls.push(((name.to_string(), index), self.loop_depth));
    }

    /// Counts an expression.
    pub(super) fn count_expression(&mut self) {
        self.cost.expressions += 1;
    }

    /// A loop begins.
    pub(super) fn count_loop(&mut self, span: Span) {
        self.loop_depth += 1;
        self.cost.loops = self.cost.loops.max(self.loop_depth);
        if self.loop_depth > MOST_LOOPS_NESTED {
            self.beyond(span, Limit::LoopsNested);
        }
    }

    /// Checks functions against the limits, with everything they call. Recursion is checked elsewhere.
    pub(super) fn check_functions(&mut self) {
        let all: usize = self.functions.values().map(Vec::len).sum();
        let many = self.functions.values().find(|list| all > MOST_FUNCTIONS || list.len() > MOST_OVERLOADS);
        if let Some(span) = many.and_then(|list| list.last()).map(|last| last.span) {
            self.beyond(span, Limit::Functions);
            return;
        }
        let mut callers: HashMap<(&str, usize), Vec<(&str, usize)>> = HashMap::new();
        let mut waits_for: HashMap<(&str, usize), usize> = HashMap::new();
        let mut ready = Vec::new();
        for (name, list) in &self.functions {
            for (index, info) in list.iter().enumerate() {
                let function = (name.as_str(), index);
                for ((called, at), _) in &info.cost.calls {
                    callers.entry((called, *at)).or_default().push(function);
                }
                waits_for.insert(function, info.cost.calls.len());
                if info.cost.calls.is_empty() {
                    ready.push(function);
                }
            }
        }
        let mut totals: HashMap<(&str, usize), Total> = HashMap::new();
        let mut found: Option<(Span, Limit)> = None;
        while let Some(function) = ready.pop() {
            let Some(info) = self.functions.get(function.0).and_then(|list| list.get(function.1)) else { continue };
            let mut total = Total { expressions: info.cost.expressions, loops: info.cost.loops, calls: 1 };
            for ((called, at), around) in &info.cost.calls {
                let Some(of) = totals.get(&(called.as_str(), *at)) else { continue };
                total.expressions = total.expressions.saturating_add(of.expressions);
                total.loops = total.loops.max(around.saturating_add(of.loops));
                total.calls = total.calls.max(of.calls.saturating_add(1));
            }
            let limit = if total.expressions > MOST_INLINED {
                Some(Limit::Inlined)
            } else if total.calls > MOST_CALLS_NESTED {
                Some(Limit::CallsNested)
            } else {
                (total.loops > MOST_LOOPS_NESTED).then_some(Limit::LoopsNested)
            };
            if let Some(limit) = limit
                && found.is_none_or(|(span, _)| info.span.start < span.start)
            {
                found = Some((info.span, limit));
            }
            totals.insert(function, total);
            for caller in callers.get(&function).into_iter().flatten() {
                if let Some(left) = waits_for.get_mut(caller) {
                    *left -= 1;
                    if *left == 0 {
                        ready.push(*caller);
                    }
                }
            }
        }
        if let Some((span, limit)) = found {
            self.beyond(span, limit);
        }
    }
}

/// Whether an expression contains a built-in limit such as `gl_MaxLights`, which only the driver knows.
fn names_limit(expr: &Expr) -> bool {
    struct Found(bool);
    impl Visitor for Found {
        fn expression(&mut self, expr: &Expr) -> bool {
            self.0 |= matches!(&expr.kind, ExprKind::Name(name) if name.starts_with("gl_Max"));
            true
        }
    }
    let mut found = Found(false);
    walk_expression(expr, &mut found);
    found.0
}
