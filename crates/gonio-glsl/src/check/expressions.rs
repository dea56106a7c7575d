//! Determines the types of expressions, and checks assignments.

use super::interface::builtin_structs;
use super::scope::Use;
use super::{Checker, ImplicitConversion, Storage, SymbolKind};
use crate::ast::{Expr, ExprKind, Literal};
use crate::{Problem, Scalar, Span, Type};

impl Checker<'_> {
    /// Determines the type of an expression and of everything in it.
    pub(super) fn expression(&mut self, expr: &mut Expr) -> Option<Type> {
        self.count_expression();
        let ty = self.type_of(expr);
        expr.ty.clone_from(&ty);
        ty
    }

    fn type_of(&mut self, expr: &mut Expr) -> Option<Type> {
        let (span, tokens) = (expr.span, expr.tokens);
        match &mut expr.kind {
            ExprKind::Literal(literal) => Some(match literal {
                Literal::Int(_) => Type::INT,
                Literal::UInt(_) => Type::UINT,
                Literal::Float(_) => Type::FLOAT,
                Literal::Double(_) => Type::Scalar(Scalar::Double),
                Literal::Bool(_) => Type::BOOL,
            }),
            ExprKind::Name(name) => self.variable(&name.clone(), span, tokens, Use::Read),
            ExprKind::Call(_) => self.call(expr),
            ExprKind::Field { base, name, name_span, .. } => {
                let base = self.expression(base)?;
                self.field(&base, &name.clone(), *name_span)
            }
            ExprKind::Index { base, index } => self.index(base, index),
            ExprKind::Length(base) => self.length(base, span),
            ExprKind::Unary { op, operand } => {
                let op = *op;
                self.unary(op, operand, span)
            }
            ExprKind::Binary { op, left, right } => {
                let op = *op;
                self.expression(left);
                self.expression(right);
                self.binary(op, left, right, span)
            }
            ExprKind::Ternary { condition, then, otherwise } => self.ternary(condition, then, otherwise, span),
            ExprKind::Assign { op, target, value } => {
                let op = *op;
                self.assign(op, target, value, span)
            }
            ExprKind::Sequence(list) => {
                let mut last = None;
                for expr in list {
                    last = self.expression(expr);
                }
                last
            }
            ExprKind::List(list) => {
                for expr in list {
                    self.expression(expr);
                }
                None
            }
        }
    }

    #[inline(never)]
    fn index(&mut self, base: &mut Expr, index: &mut Expr) -> Option<Type> {
        let base = self.expression(base);
        self.index_value(index);
        let value = self.value_of(index).and_then(|v| v.first().copied());
        self.element(&base?, value, index.span)
    }

    #[inline(never)]
    fn index_value(&mut self, index: &mut Expr) {
        let found = self.expression(index);
        if let Some(found) = found.filter(|t| *t != Type::INT && *t != Type::UINT) {
            let message = format!("an index must be an `int`, found `{found}`");
            self.error(index.span, "index-type", message);
        }
    }

    #[inline(never)]
    fn length(&mut self, base: &mut Expr, span: Span) -> Option<Type> {
        let found = self.expression(base)?;
        if !matches!(found, Type::Array(..) | Type::Vector(..) | Type::Matrix { .. }) {
            self.error(span, "no-length", format!("`{found}` has no `.length()`"));
        }
        Some(Type::INT)
    }

    #[inline(never)]
    fn ternary(&mut self, condition: &mut Expr, then: &mut Expr, otherwise: &mut Expr, span: Span) -> Option<Type> {
        let found = self.expression(condition);
        let (a, b) = (self.expression(then), self.expression(otherwise));
        if let Some(found) = found.filter(|t| *t != Type::BOOL) {
            let message = format!("the condition of `?:` must be a `bool`, found `{found}`");
            self.error(condition.span, "condition-type", message);
        }
        let (a, b) = (a?, b?);
        if a.becomes(&b) {
            self.convert(then, Some(&b), "this value");
            Some(b)
        } else if b.becomes(&a) {
            self.convert(otherwise, Some(&a), "this value");
            Some(a)
        } else {
            let message = format!("both results of `?:` must have the same type, found `{a}` and `{b}`");
            self.error(span, "wrong-type", message);
            None
        }
    }

    #[inline(never)]
    fn assign(
        &mut self,
        op: Option<crate::ast::BinaryOp>,
        target: &mut Expr,
        value: &mut Expr,
        span: Span,
    ) -> Option<Type> {
        let is_list = matches!(value.kind, ExprKind::List(_));
        if !is_list {
            self.expression(value);
        }
        let Some(op) = op else {
            let mut ty = self.target(target, true)?;
            if is_list {
                self.list(value, &mut ty);
            } else {
                self.convert(value, Some(&ty), "this value");
            }
            return Some(ty);
        };
        let ty = self.target(target, false);
        let result = self.binary(op, target, value, span)?;
        let ty = ty?;
        if result != ty && !result.becomes(&ty) {
            let message =
                format!("`{}=` gives `{result}`, but `{}` is of type `{ty}`", op.mark(), self.parsed.text(target.span));
            self.error(span, "wrong-type", message);
        }
        Some(ty)
    }

    /// Checks an assignment target; `is_whole` if its old value does not matter.
    pub(super) fn target(&mut self, expr: &mut Expr, is_whole: bool) -> Option<Type> {
        let ty = self.target_type(expr, is_whole);
        expr.ty.clone_from(&ty);
        ty
    }

    #[inline(never)]
    fn target_type(&mut self, expr: &mut Expr, is_whole: bool) -> Option<Type> {
        let (span, tokens) = (expr.span, expr.tokens);
        match &mut expr.kind {
            ExprKind::Name(name) => {
                let name = name.clone();
                let ty = self.variable(&name, span, tokens, if is_whole { Use::Write } else { Use::Read });
                self.writable(&name, span);
                ty
            }
            ExprKind::Field { base, name, name_span, .. } => {
                let base_type = self.target(base, is_whole)?;
                let twice = name.char_indices().any(|(i, c)| name[..i].contains(c));
                if twice && matches!(base_type, Type::Vector(..)) {
                    let message = format!("`.{name}` repeats a component and cannot be assigned to");
                    self.error(*name_span, "not-writable", message);
                }
                self.field(&base_type, &name.clone(), *name_span)
            }
            ExprKind::Index { base, index } => {
                self.index_value(index);
                let base = self.target(base, is_whole)?;
                let value = self.value_of(index).and_then(|v| v.first().copied());
                self.element(&base, value, index.span)
            }
            _ => {
                let ty = self.type_of(expr);
                if !self.has_syntax_errors {
                    self.error(span, "not-writable", "cannot assign to this: it is not a variable");
                }
                ty
            }
        }
    }

    fn writable(&mut self, name: &str, span: Span) {
        let Some(id) = self.find(name) else {
            let found = crate::builtins::variable(name, self.stage, self.version);
            if matches!(found, Some(Ok(found)) if !found.is_writable) {
                self.error(span, "not-writable", format!("cannot assign to `{name}`: it is read-only here"));
            }
            return;
        };
        self.access(id, true, span);
        let symbol = &self.symbols[id];
        let reason = match symbol.storage {
            Storage::Const => "it is a constant",
            Storage::Uniform => "it is a uniform, which only the program can set",
            Storage::In if symbol.kind != SymbolKind::Param => "it is an input, which is read-only",
            _ => return,
        };
        // Redeclared built-in variables keep their own rules.
        if name.starts_with("gl_") {
            return;
        }
        let problem = Problem::error(span, "not-writable", format!("cannot assign to `{name}`: {reason}"));
        self.problems.push(problem.with_help("assign to a variable of your own"));
    }

    /// Checks `.xyz` or `.member`.
    #[inline(never)]
    pub(super) fn field(&mut self, base: &Type, name: &str, span: Span) -> Option<Type> {
        match base {
            Type::Vector(scalar, size) => self.swizzle(*scalar, *size, name, span),
            // From 4.20 on a scalar has components too.
            Type::Scalar(scalar) if self.version.is_at_least(420, 0) => self.swizzle(*scalar, 1, name, span),
            Type::Struct(of) => {
                let known = self.structs.get(of);
                let info = known.or_else(|| builtin_structs().iter().find(|info| info.name == *of))?;
                if let Some((_, ty)) = info.members.iter().find(|(member, _)| member == name) {
                    return ty.clone();
                }
                let near = crate::nearest::nearest(name, info.members.iter().map(|m| &*m.0)).map(str::to_string);
                let of = of.trim_end_matches(" (block)");
                let mut problem = Problem::error(span, "unknown-member", format!("`{of}` has no member `{name}`"));
                if let Some(near) = near {
                    problem = problem.did_you_mean(name, &near);
                }
                self.unknown(problem);
                None
            }
            Type::Array(..) if name == "length" => None,
            _ => {
                self.error(span, "no-components", format!("`{base}` has no `.{name}`"));
                None
            }
        }
    }

    #[inline(never)]
    fn swizzle(&mut self, scalar: Scalar, size: u8, name: &str, span: Span) -> Option<Type> {
        let sets = ["xyzw", "rgba", "stpq"];
        let set = sets.iter().find(|set| name.chars().all(|c| set.contains(c)));
        let Some(set) = set.filter(|_| name.len() <= 4) else {
            let message = match name.len() > 4 {
                true => format!("`.{name}` selects more than four components"),
                false => format!(
                    "`.{name}` is not a valid swizzle: use letters of `xyzw`, `rgba` or `stpq`, without mixing them"
                ),
            };
            self.error(span, "bad-swizzle", message);
            return None;
        };
        let most = name.chars().filter_map(|c| set.find(c)).max().unwrap_or(0);
        if most >= usize::from(size) {
            let ty = Type::scalar_or_vector(scalar, size);
            let message = format!("`{ty}` has no component `{}`", &set[most..=most]);
            self.error(span, "bad-swizzle", message);
            return None;
        }
        Some(Type::scalar_or_vector(scalar, name.len() as u8))
    }

    /// Returns the type of an element.
    #[inline(never)]
    fn element(&mut self, base: &Type, index: Option<f64>, span: Span) -> Option<Type> {
        let (of, count) = match base {
            Type::Array(of, count) => ((**of).clone(), *count),
            Type::Vector(scalar, size) => (Type::Scalar(*scalar), Some(u32::from(*size))),
            Type::Matrix { scalar, columns, rows } => {
                (Type::scalar_or_vector(*scalar, *rows), Some(u32::from(*columns)))
            }
            _ => {
                self.error(span, "not-an-array", format!("`{base}` cannot be indexed"));
                return None;
            }
        };
        if let (Some(count), Some(index)) = (count, index)
            && (index < 0.0 || index >= f64::from(count))
        {
            let message = format!("the index {index} is out of range: expected 0 to {}", count - 1);
            self.error(span, "index-range", message);
        }
        Some(of)
    }

    /// Checks that a value can be converted to `to`, and records an implicit conversion.
    #[inline(never)]
    pub(super) fn convert(&mut self, value: &Expr, to: Option<&Type>, subject: &str) {
        let (Some(from), Some(to)) = (&value.ty, to) else { return };
        if from == to {
            return;
        }
        if !from.becomes(to) {
            let problem =
                Problem::error(value.span, "wrong-type", format!("cannot convert {subject} from `{from}` to `{to}`"));
            let problem = match cure(from, to) {
                Some(help) => problem.with_help(help),
                None => problem,
            };
            self.problems.push(problem);
            return;
        }
        if from.scalar() == to.scalar() {
            return;
        }
        self.note_conversion(value, from.clone(), to.clone());
    }

    pub(super) fn note_conversion(&mut self, value: &Expr, from: Type, to: Type) {
        let version = self.version;
        let is_float = matches!(to.scalar(), Some(Scalar::Float | Scalar::Double));
        let is_allowed = if is_float { version.converts_int_to_float() } else { version.converts_int_to_uint() };
        if !is_allowed {
            let text = self.parsed.text(value.span);
            let message = format!(
                "`{text}` has type `{from}`, which is not converted to `{to}` implicitly in version {}",
                version.written()
            );
            let is_number = matches!(value.kind, ExprKind::Literal(Literal::Int(_))) && is_float;
            let help = if is_number { format!("write `{text}.0`") } else { format!("write `{to}({text})`") };
            self.problems.push(Problem::strict(value.span, "implicit-conversion", message).with_help(help));
        }
        self.conversions.push(ImplicitConversion {
            tokens: value.tokens,
            span: value.span,
            from,
            to,
            is_literal: matches!(value.kind, ExprKind::Literal(_)),
        });
    }

    /// Whether the value is a constant expression: literals, constants, and functions of these.
    pub(super) fn is_constant(&self, expr: &Expr) -> bool {
        match &expr.kind {
            ExprKind::Literal(_) => true,
            ExprKind::Length(_) => true,
            ExprKind::Name(name) => match self.find(name) {
                Some(id) => {
                    let symbol = &self.symbols[id];
                    symbol.storage == Storage::Const && symbol.kind != SymbolKind::Param && !self.computed.contains(&id)
                }
                None => name.starts_with("gl_Max"),
            },
            ExprKind::Call(call) => {
                !self.functions.contains_key(&call.name)
                    && !call.name.starts_with("tex")
                    && call.args.iter().all(|a| self.is_constant(a))
            }
            ExprKind::Field { base, .. } => self.is_constant(base),
            ExprKind::Index { base, index } => self.is_constant(base) && self.is_constant(index),
            ExprKind::Unary { operand, .. } => self.is_constant(operand),
            ExprKind::Binary { left, right, .. } => self.is_constant(left) && self.is_constant(right),
            ExprKind::Ternary { condition, then, otherwise } => {
                self.is_constant(condition) && self.is_constant(then) && self.is_constant(otherwise)
            }
            ExprKind::Assign { .. } => false,
            ExprKind::Sequence(list) | ExprKind::List(list) => list.iter().all(|e| self.is_constant(e)),
        }
    }
}

/// Suggests how to convert one type to the other.
fn cure(from: &Type, to: &Type) -> Option<String> {
    match (from, to) {
        (Type::Vector(Scalar::Float, 4), Type::Vector(Scalar::Float, 3)) => {
            Some("use `.xyz` for the first three components".into())
        }
        (Type::Vector(Scalar::Float, 3), Type::Vector(Scalar::Float, 4)) => {
            Some("write `vec4(.., 1.0)` to add a fourth component".into())
        }
        (Type::Scalar(_), Type::Vector(Scalar::Float, _)) => {
            Some(format!("if one number is meant, declare it as `{from}`; `{to}(..)` puts it into every component"))
        }
        (Type::Vector(Scalar::Float, _), Type::Scalar(Scalar::Float)) => {
            Some("use one component such as `.x`, or `dot` or `length`; or declare a vector".into())
        }
        (Type::Scalar(_), Type::Scalar(_)) => Some(format!("write `{to}(..)` to convert it")),
        (Type::Matrix { columns: 4, rows: 4, .. }, Type::Matrix { columns: 3, rows: 3, .. }) => {
            Some("write `mat3(..)` for its upper left part".into())
        }
        _ => None,
    }
}
