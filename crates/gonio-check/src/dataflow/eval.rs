//! Evaluates expressions symbolically.

use super::graph::{Graph, Id, Op, component};
use super::run::{Roles, Runner};
use crate::roles::Role;
use gonio_glsl::ast::{BinaryOp, Call, Function, Literal, UnaryOp};
use gonio_glsl::{Expr, ExprKind, Span, Type};

/// Returns the role of an input or of a part of one: `lights[0].position`, `matrices.M` of a block.
pub(crate) fn role(roles: &Roles, name: &str) -> Option<Role> {
    let found = |name: &str| roles.get(name).or_else(|| roles.get(&format!("{name}[0]"))).copied();
    found(name).or_else(|| {
        let (front, index) = name.strip_suffix(']')?.rsplit_once('[')?;
        // Element i of an array of colours belongs to light i.
        let role = found(front)?;
        Some(role.with_light(role.light()? + index.parse::<u32>().ok()?))
    })
}

impl<'a> Runner<'a> {
    /// Evaluates an expression with its side effects and returns its node.
    pub(crate) fn expression(&mut self, expr: &'a Expr) -> Id {
        let id = if self.enter() { self.expression_within(expr) } else { Graph::UNKNOWN };
        self.leave();
        id
    }

    fn expression_within(&mut self, expr: &'a Expr) -> Id {
        let (span, ty) = (expr.span, expr.ty.as_ref());
        match &expr.kind {
            ExprKind::Literal(literal) => {
                let value = match literal {
                    Literal::Int(value) => *value as f64,
                    Literal::UInt(value) => f64::from(*value),
                    Literal::Float(value) | Literal::Double(value) => *value,
                    Literal::Bool(value) => f64::from(u8::from(*value)),
                };
                self.push(Op::Number(vec![value]), span, ty)
            }
            ExprKind::Name(name) => self.name(name, span, ty),
            ExprKind::Call(call) => self.call_expression(call, span, ty),
            ExprKind::Field { base, name, .. } => {
                let is_swizzle = matches!(base.ty, Some(Type::Vector(..) | Type::Scalar(_)));
                let base = self.expression(base);
                if is_swizzle { self.swizzle(base, name, span, ty) } else { self.member(base, name, span, ty) }
            }
            ExprKind::Index { base, index } => {
                let (base, index) = (self.expression(base), self.expression(index));
                self.element(base, index, span, ty)
            }
            ExprKind::Length(base) => {
                self.expression(base);
                Graph::UNKNOWN
            }
            ExprKind::Unary { op, operand } => self.unary(*op, operand, span, ty),
            ExprKind::Binary { op, left, right } => {
                let (left, right) = (self.expression(left), self.expression(right));
                self.push(Op::Binary(*op, left, right), span, ty)
            }
            ExprKind::Ternary { condition, then, otherwise } => {
                let condition = self.expression(condition);
                let (then, otherwise) = (self.expression(then), self.expression(otherwise));
                match self.graph.scalar(condition) {
                    Some(known) => {
                        if known == 0.0 {
                            otherwise
                        } else {
                            then
                        }
                    }
                    None => self.push(Op::Select(condition, then, otherwise), span, ty),
                }
            }
            ExprKind::Assign { op, target, value } => {
                let value = self.expression(value);
                let value = match op {
                    None => value,
                    Some(op) => {
                        let before = self.expression(target);
                        self.push(Op::Binary(*op, before, value), span, target.ty.as_ref())
                    }
                };
                self.assign(target, value, span);
                value
            }
            ExprKind::Sequence(list) => list.iter().map(|part| self.expression(part)).last().unwrap_or(Graph::UNKNOWN),
            ExprKind::List(list) => {
                let parts = list.iter().map(|part| self.expression(part)).collect();
                let op =
                    if matches!(ty, Some(Type::Array(..)) | None) { Op::Array(parts) } else { Op::Construct(parts) };
                self.push(op, span, ty)
            }
        }
    }

    fn name(&mut self, name: &str, span: Span, ty: Option<&Type>) -> Id {
        let found = self.scopes.iter().enumerate().rev().find_map(|(i, scope)| Some((i, *scope.get(name)?)));
        match found {
            Some((0, id)) => self.read(id, span),
            Some((_, id)) => id,
            None => {
                let role = role(self.roles, name);
                self.push(Op::Input { name: name.to_owned(), role }, span, ty)
            }
        }
    }

    /// Creates the nodes of inputs where they are read, not where they are declared.
    fn read(&mut self, id: Id, span: Span) -> Id {
        match self.graph.op(id) {
            op @ (Op::Input { .. } | Op::Interpolated(_)) => {
                let op = op.clone();
                self.graph.push_like(op, id, self.stage, span)
            }
            _ => id,
        }
    }

    fn swizzle(&mut self, base: Id, letters: &str, span: Span, ty: Option<&Type>) -> Id {
        if let Op::Write(_, written, value) = self.graph.op(self.graph.plain(base))
            && written == letters
        {
            return *value;
        }
        let single = letters.chars().next().filter(|_| letters.len() == 1).and_then(component);
        if let Some(index) = single {
            match self.graph.op(self.graph.plain(base)) {
                // One number for all components, or one for each.
                Op::Construct(parts) if parts.iter().all(|part| self.graph.node(*part).width == 1) => {
                    if let Some(part) = if parts.len() == 1 { parts.first() } else { parts.get(index) } {
                        return *part;
                    }
                }
                Op::Write(before, written, value) => {
                    let (before, value) = (*before, *value);
                    return match written.chars().position(|letter| component(letter) == Some(index)) {
                        Some(_) if written.len() == 1 => value,
                        Some(place) => {
                            let letter = ["x", "y", "z", "w"][place.min(3)];
                            self.push(Op::Swizzle(value, letter.to_owned()), span, ty)
                        }
                        None if before == Graph::UNKNOWN => before,
                        None => {
                            // Each step removes one write, but a hostile shader may have many.
                            if !self.enter() {
                                self.leave();
                                return Graph::UNKNOWN;
                            }
                            let id = self.swizzle(before, letters, span, ty);
                            self.leave();
                            id
                        }
                    };
                }
                _ => {}
            }
        }
        self.push(Op::Swizzle(base, letters.to_owned()), span, ty)
    }

    fn member(&mut self, base: Id, name: &str, span: Span, ty: Option<&Type>) -> Id {
        if let Some(id) = self.member_of_struct(base, name) {
            return self.read(id, span);
        }
        match self.graph.op(self.graph.plain(base)) {
            Op::Input { name: path, .. } => {
                let path = format!("{path}.{name}");
                let role = role(self.roles, &path);
                self.push(Op::Input { name: path, role }, span, ty)
            }
            Op::Select(test, a, b) => {
                let (test, a, b) = (*test, *a, *b);
                match (self.member_of_struct(a, name), self.member_of_struct(b, name)) {
                    (Some(a), Some(b)) if a == b => a,
                    (Some(a), Some(b)) => self.push(Op::Select(test, a, b), span, ty),
                    (one, other) => one.or(other).unwrap_or(Graph::UNKNOWN),
                }
            }
            _ => Graph::UNKNOWN,
        }
    }

    fn element(&mut self, base: Id, index: Id, span: Span, ty: Option<&Type>) -> Id {
        // If the index is unknown, the first element represents all.
        let known = self.graph.scalar(index).map(|index| index.max(0.0) as usize);
        match self.graph.op(self.graph.plain(base)) {
            Op::Array(parts) => parts.get(known.unwrap_or(0)).copied().unwrap_or(Graph::UNKNOWN),
            Op::Input { name, .. } if !matches!(ty, Some(Type::Vector(..))) || !self.graph.node(base).is_matrix => {
                let path = format!("{name}[{}]", known.unwrap_or(0));
                let role = role(self.roles, &path);
                self.push(Op::Input { name: path, role }, span, ty)
            }
            _ => self.push(Op::Index(base, known), span, ty),
        }
    }

    fn unary(&mut self, op: UnaryOp, operand: &'a Expr, span: Span, ty: Option<&Type>) -> Id {
        let value = self.expression(operand);
        match op {
            UnaryOp::Plus => value,
            UnaryOp::Minus => self.push(Op::Neg(value), span, ty),
            UnaryOp::Not | UnaryOp::Complement => {
                let name = if op == UnaryOp::Not { "!" } else { "~" };
                self.push(Op::Call(name.to_owned(), vec![value]), span, ty)
            }
            UnaryOp::PreIncrement | UnaryOp::PreDecrement | UnaryOp::PostIncrement | UnaryOp::PostDecrement => {
                let is_up = matches!(op, UnaryOp::PreIncrement | UnaryOp::PostIncrement);
                let one = self.push(Op::Number(vec![1.0]), span, ty);
                let step = if is_up { BinaryOp::Add } else { BinaryOp::Subtract };
                let after = self.push(Op::Binary(step, value, one), span, ty);
                self.assign(operand, after, span);
                if matches!(op, UnaryOp::PreIncrement | UnaryOp::PreDecrement) { after } else { value }
            }
        }
    }

    fn call_expression(&mut self, call: &'a Call, span: Span, ty: Option<&Type>) -> Id {
        let args: Vec<Id> = call.args.iter().map(|arg| self.expression(arg)).collect();
        if call.is_constructor {
            if !call.sizes.is_empty() || matches!(ty, Some(Type::Array(..))) {
                return self.push(Op::Array(args), span, ty);
            }
            if let Some(members) = self.members(&call.name) {
                let fields = members.iter().map(|(name, _)| name.clone()).zip(args).collect();
                return self.push(Op::Struct(fields), span, ty);
            }
            // `float(x)` and `vec3(v)` of a vec3 change nothing.
            if let [one] = args[..] {
                let node = self.graph.node(one);
                let components = ty.and_then(Type::components);
                if node.width > 0 && Some(u32::from(node.width)) == components && !node.is_matrix && !node.is_integer {
                    return one;
                }
            }
            return self.push(Op::Construct(args), span, ty);
        }
        let Some(function) = self.overload(call) else {
            if let (true, [a, b]) = (call.name == "dot", &args[..])
                && let Some(sum) = self.sum_of_products(*a, *b, span, ty)
            {
                return sum;
            }
            return self.push(Op::Call(call.name.clone(), args), span, ty);
        };
        let (value, written) = self.call(function, &args, span);
        for ((param, arg), after) in function.params.iter().zip(&call.args).zip(written) {
            if param.qualifiers.iter().any(|q| q.word == "out" || q.word == "inout") {
                self.assign(arg, after, arg.span);
            }
        }
        value
    }

    /// Expands `dot(vec3(a, b, c), vec3(1.0, d, d * d))` to the sum that it means.
    fn sum_of_products(&mut self, a: Id, b: Id, span: Span, ty: Option<&Type>) -> Option<Id> {
        let parts = |id: Id| match self.graph.op(self.graph.plain(id)) {
            Op::Construct(parts) if parts.iter().all(|part| self.graph.node(*part).width == 1) => Some(parts.clone()),
            _ => None,
        };
        let (a, b) = (parts(a)?, parts(b)?);
        if a.len() != b.len() || a.len() < 2 {
            return None;
        }
        let mut sum = None;
        for (a, b) in a.into_iter().zip(b) {
            let product = self.push(Op::Binary(BinaryOp::Multiply, a, b), span, ty);
            sum = Some(match sum {
                Some(sum) => self.push(Op::Binary(BinaryOp::Add, sum, product), span, ty),
                None => product,
            });
        }
        sum
    }

    fn overload(&self, call: &Call) -> Option<&'a Function> {
        let of_count: Vec<&'a Function> = self
            .functions
            .get(call.name.as_str())?
            .iter()
            .copied()
            .filter(|function| function.params.len() == call.args.len())
            .collect();
        let fits = |function: &&&Function| {
            function.params.iter().zip(&call.args).all(|(param, arg)| {
                Type::named(&param.ty.name).is_none_or(|ty| arg.ty.as_ref().is_none_or(|arg| *arg == ty))
            })
        };
        of_count.iter().find(fits).or(of_count.first()).copied()
    }

    fn assign(&mut self, target: &'a Expr, value: Id, span: Span) {
        if self.enter() {
            self.assign_within(target, value, span);
        }
        self.leave();
    }

    fn assign_within(&mut self, target: &'a Expr, value: Id, span: Span) {
        match &target.kind {
            ExprKind::Name(name) => {
                let op = Op::Copy(value, name.clone());
                let id = self.graph.push_like(op, value, self.stage, span);
                match self.scopes.iter_mut().rev().find(|scope| scope.contains_key(name)) {
                    Some(scope) => {
                        scope.insert(name.clone(), id);
                    }
                    // A built-in function or variable such as gl_Position.
                    None => {
                        self.scopes[0].insert(name.clone(), id);
                    }
                }
            }
            ExprKind::Field { base, name, .. } => {
                let is_swizzle = matches!(base.ty, Some(Type::Vector(..) | Type::Scalar(_)));
                let before = self.expression(base);
                let after = if is_swizzle {
                    let op = Op::Write(before, name.clone(), value);
                    self.push(op, span, base.ty.as_ref())
                } else {
                    let mut fields = match self.graph.op(self.graph.plain(before)) {
                        Op::Struct(fields) => fields.clone(),
                        _ => Vec::new(),
                    };
                    let op = Op::Copy(value, name.clone());
                    let id = self.graph.push_like(op, value, self.stage, span);
                    match fields.iter_mut().find(|(field, _)| field == name) {
                        Some(field) => field.1 = id,
                        None => fields.push((name.clone(), id)),
                    }
                    self.push(Op::Struct(fields), span, base.ty.as_ref())
                };
                self.assign(base, after, span);
            }
            ExprKind::Index { base, index } => {
                let (before, index) = (self.expression(base), self.expression(index));
                let known = self.graph.scalar(index).map_or(0, |index| index.clamp(0.0, 63.0) as usize);
                let is_array = matches!(base.ty, Some(Type::Array(..)) | None);
                let after = if is_array || matches!(&base.kind, ExprKind::Name(name) if name == "gl_FragData") {
                    let mut parts = match self.graph.op(self.graph.plain(before)) {
                        Op::Array(parts) => parts.clone(),
                        _ => Vec::new(),
                    };
                    if parts.len() <= known {
                        parts.resize(known + 1, Graph::UNKNOWN);
                    }
                    parts[known] = value;
                    self.push(Op::Array(parts), span, base.ty.as_ref())
                } else {
                    let letters = match base.ty {
                        Some(Type::Vector(..)) => ["x", "y", "z", "w"][known.min(3)].to_owned(),
                        _ => format!("[{known}]"),
                    };
                    self.push(Op::Write(before, letters, value), span, base.ty.as_ref())
                };
                self.assign(base, after, span);
            }
            _ => {}
        }
    }
}
