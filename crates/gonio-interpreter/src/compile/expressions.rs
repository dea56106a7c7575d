//! Expressions: each is evaluated into registers that nothing else uses, so that its value can be replaced. Operators
//! (GLSL 4.60, section 5.9), constructors and initializer lists (section 5.4).

use super::{Compiler, Result, unsupported};
use crate::code::{Instr, One, Reg, Two};
use crate::layout::scalar_of;
use gonio_glsl::ast::{BinaryOp, Call, Literal, UnaryOp};
use gonio_glsl::{Expr, ExprKind, Scalar, Span, Type};

impl Compiler<'_> {
    /// Evaluates an expression, converted as its context needs it, into new registers.
    pub(super) fn evaluate(&mut self, expr: &Expr) -> Result<Reg> {
        let ty = self.type_of(expr)?;
        let n = self.size(&ty, expr.span)?;
        let dst = self.allocate(n.max(1))?;
        self.evaluate_into(expr, dst)?;
        Ok(dst)
    }

    /// Evaluates an expression, converted as its context needs it.
    pub(super) fn evaluate_into(&mut self, expr: &Expr, dst: Reg) -> Result<()> {
        self.enter(expr.span)?;
        let (place, next) = (self.place, self.next);
        self.place = self.source.id(expr).or(place);
        let (raw, to) = (self.raw_type(expr)?, self.type_of(expr)?);
        let n = self.size(&raw, expr.span)?;
        let converts = raw.scalar() != to.scalar();
        let value = if converts { self.allocate(n)? } else { dst };
        self.kind_into(expr, value, &raw)?;
        if raw != Type::Void
            && let Some(id) = self.source.id(expr)
        {
            self.mark(id, value, n)?;
        }
        if converts {
            self.convert(dst, value, n, scalar_of(&raw), scalar_of(&to))?;
        }
        (self.place, self.next) = (place, next);
        self.nested -= 1;
        Ok(())
    }

    fn kind_into(&mut self, expr: &Expr, dst: Reg, ty: &Type) -> Result<()> {
        match &expr.kind {
            ExprKind::Literal(literal) => {
                let bits = match literal {
                    Literal::Int(value) => *value as u32,
                    Literal::UInt(value) => *value,
                    Literal::Float(value) | Literal::Double(value) => (*value as f32).to_bits(),
                    Literal::Bool(value) => u32::from(*value),
                };
                self.emit(Instr::Constant { dst, bits })
            }
            ExprKind::Name(_) | ExprKind::Field { .. } | ExprKind::Index { .. } => {
                let place = self.place(expr)?;
                self.mark_base(expr)?;
                self.load(dst, &place)
            }
            ExprKind::Call(call) => {
                if call.is_constructor {
                    self.construct(call, dst, ty, expr.span)
                } else if let Some(symbol) = self.called(call) {
                    self.call(symbol, call, expr, dst)
                } else {
                    self.builtin(call, expr, dst, ty)
                }
            }
            ExprKind::Length(base) => {
                let base = self.raw_type(base)?;
                let count = match &base {
                    Type::Array(_, count) => count.unwrap_or(crate::layout::OPEN_ARRAY),
                    Type::Vector(_, n) => u32::from(*n),
                    Type::Matrix { columns, .. } => u32::from(*columns),
                    other => return Err(unsupported(format!("`.length()` of a `{other}`"), expr.span)),
                };
                self.emit(Instr::Constant { dst, bits: count })
            }
            ExprKind::Unary { op, operand } => self.unary(*op, operand, dst, ty),
            ExprKind::Binary { op: op @ (BinaryOp::And | BinaryOp::Or), left, right } => {
                self.short_circuit(*op == BinaryOp::And, left, right, dst)
            }
            ExprKind::Binary { op, left, right } => {
                let (a, b) = (self.type_of(left)?, self.type_of(right)?);
                let (left, right) = (self.evaluate(left)?, self.evaluate(right)?);
                self.binary(*op, dst, (left, &a), (right, &b), expr.span)
            }
            ExprKind::Ternary { condition, then, otherwise } => {
                let n = self.size(ty, expr.span)?;
                let condition = self.evaluate(condition)?;
                let at = self.code.len();
                self.emit(Instr::If { condition, otherwise: 0 })?;
                let src = self.evaluate(then)?;
                self.emit(Instr::Store { dst, src, n })?;
                let other = self.code.len();
                self.emit(Instr::Else { end: 0 })?;
                self.otherwise(otherwise, dst, n)?;
                self.end_branch(condition, at, other)
            }
            ExprKind::Assign { op, target, value } => self.assign(*op, target, value, dst, expr),
            ExprKind::Sequence(list) => {
                let Some((last, first)) = list.split_last() else { return Ok(()) };
                for expr in first {
                    self.evaluate_unused(expr)?;
                }
                self.evaluate_into(last, dst)
            }
            ExprKind::List(list) => self.list(list, dst, ty, expr.span),
        }
    }

    /// Evaluates the last operand of a ternary operator for the lanes that take it. Another ternary operator writes no
    /// other lanes, so a chain of them needs no copies.
    fn otherwise(&mut self, expr: &Expr, dst: Reg, n: u32) -> Result<()> {
        if matches!(expr.kind, ExprKind::Ternary { .. }) && self.raw_type(expr)? == self.type_of(expr)? {
            return self.evaluate_into(expr, dst);
        }
        let src = self.evaluate(expr)?;
        self.emit(Instr::Store { dst, src, n })
    }

    /// Evaluates the right side only where the left side does not decide.
    fn short_circuit(&mut self, is_and: bool, left: &Expr, right: &Expr, dst: Reg) -> Result<()> {
        self.evaluate_into(left, dst)?;
        let condition = self.allocate(1)?;
        self.emit(match is_and {
            true => Instr::Copy { dst: condition, src: dst, n: 1 },
            false => Instr::One { op: One::Not, dst: condition, a: dst, n: 1 },
        })?;
        let at = self.code.len();
        self.emit(Instr::If { condition, otherwise: 0 })?;
        let src = self.evaluate(right)?;
        self.emit(Instr::Store { dst, src, n: 1 })?;
        let other = self.code.len();
        self.emit(Instr::Else { end: 0 })?;
        self.end_branch(condition, at, other)
    }

    fn assign(&mut self, op: Option<BinaryOp>, target: &Expr, value: &Expr, dst: Reg, expr: &Expr) -> Result<()> {
        let ty = self.raw_type(target)?;
        let n = self.size(&ty, expr.span)?;
        match op {
            None => {
                self.evaluate_into(value, dst)?;
                let place = self.place(target)?;
                self.store(&place, dst, expr.span)
            }
            Some(op) => {
                let value_type = self.type_of(value)?;
                let value = self.evaluate(value)?;
                let place = self.place(target)?;
                let before = self.allocate(n)?;
                self.load(before, &place)?;
                let to = self.type_of(target)?;
                if to.scalar() != ty.scalar() {
                    return Err(unsupported(format!("`{}=` with these types", op.mark()), expr.span));
                }
                self.binary(op, dst, (before, &ty), (value, &value_type), expr.span)?;
                self.store(&place, dst, expr.span)
            }
        }
    }

    fn unary(&mut self, op: UnaryOp, operand: &Expr, dst: Reg, ty: &Type) -> Result<()> {
        let n = self.size(ty, operand.span)?;
        let is_float = ty.scalar() == Some(Scalar::Float);
        let one = match op {
            UnaryOp::Plus => return self.evaluate_into(operand, dst),
            UnaryOp::Minus if is_float => One::FNeg,
            UnaryOp::Minus => One::INeg,
            UnaryOp::Not => One::Not,
            UnaryOp::Complement => One::Complement,
            _ => return self.increment(op, operand, dst, n, is_float),
        };
        let a = self.evaluate(operand)?;
        self.emit(Instr::One { op: one, dst, a, n })
    }

    fn increment(&mut self, op: UnaryOp, operand: &Expr, dst: Reg, n: u32, is_float: bool) -> Result<()> {
        let place = self.place(operand)?;
        let (before, after, one) = (self.allocate(n)?, self.allocate(n)?, self.allocate(1)?);
        self.load(before, &place)?;
        self.emit(Instr::Constant { dst: one, bits: if is_float { 1.0_f32.to_bits() } else { 1 } })?;
        let is_up = matches!(op, UnaryOp::PreIncrement | UnaryOp::PostIncrement);
        let two = match (is_up, is_float) {
            (true, true) => Two::FAdd,
            (true, false) => Two::IAdd,
            (false, true) => Two::FSub,
            (false, false) => Two::ISub,
        };
        self.emit(Instr::Two { op: two, dst: after, a: before, b: one, n, steps: [1, 0] })?;
        self.store(&place, after, operand.span)?;
        let is_before = matches!(op, UnaryOp::PostIncrement | UnaryOp::PostDecrement);
        self.emit(Instr::Copy { dst, src: if is_before { before } else { after }, n })
    }
}

impl Compiler<'_> {
    /// Applies an operator to values of the same component type.
    pub(super) fn binary(
        &mut self,
        op: BinaryOp,
        dst: Reg,
        (left, a): (Reg, &Type),
        (right, b): (Reg, &Type),
        span: Span,
    ) -> Result<()> {
        use BinaryOp::*;
        match op {
            Equal | NotEqual => return self.equality(op == Equal, dst, left, right, a, span),
            Multiply if is_product(a, b) => return self.product(dst, (left, a), (right, b)),
            _ => {}
        }
        let scalar = scalar_of(a);
        let two = operation(op, scalar).ok_or_else(|| unsupported(format!("`{}` of a `{a}`", op.mark()), span))?;
        let (na, nb) = (self.size(a, span)?, self.size(b, span)?);
        let n = na.max(nb);
        self.emit(Instr::Two { op: two, dst, a: left, b: right, n, steps: [u8::from(na > 1), u8::from(nb > 1)] })
    }

    /// Compares values of any type without samplers.
    fn equality(&mut self, is_equal: bool, dst: Reg, left: Reg, right: Reg, ty: &Type, span: Span) -> Result<()> {
        let n = self.size(ty, span)?;
        let each = self.allocate(n)?;
        let mut at = 0;
        // Neighbouring components of one type are compared together.
        for (is_float, length) in self.stretches(ty) {
            let op = if is_float { Two::FEqual } else { Two::IEqual };
            self.emit(Instr::Two { op, dst: each + at, a: left + at, b: right + at, n: length, steps: [1, 1] })?;
            at += length;
        }
        self.emit(Instr::Reduce { dst, a: each, n, all: true })?;
        if !is_equal {
            self.emit(Instr::One { op: One::Not, dst, a: dst, n: 1 })?;
        }
        Ok(())
    }

    fn stretches(&self, ty: &Type) -> Vec<(bool, u32)> {
        let mut found: Vec<(bool, u32)> = Vec::new();
        for part in self.layouts.parts("", ty) {
            let is_float = scalar_of(&part.ty) == Scalar::Float;
            let size = self.layouts.size(&part.ty).unwrap_or(0) * part.count;
            match found.last_mut() {
                Some((was, length)) if *was == is_float => *length += size,
                _ => found.push((is_float, size)),
            }
        }
        found
    }

    /// Multiplies matrices and vectors: each component is a dot product of a row with a column.
    pub(super) fn product(&mut self, dst: Reg, (left, a): (Reg, &Type), (right, b): (Reg, &Type)) -> Result<()> {
        let shape = |ty: &Type, is_left: bool| match ty {
            Type::Matrix { columns, rows, .. } => (u32::from(*columns), u32::from(*rows)),
            // A vector on the left is a row, on the right a column.
            Type::Vector(_, n) if is_left => (u32::from(*n), 1),
            Type::Vector(_, n) => (1, u32::from(*n)),
            _ => (1, 1),
        };
        let ((inner, rows), (columns, _)) = (shape(a, true), shape(b, false));
        for column in 0..columns {
            for row in 0..rows {
                let (dst, a, b) = (dst + column * rows + row, left + row, right + column * inner);
                self.emit(Instr::Dot { dst, a, b, n: inner as u8, steps: [rows as u8, 1] })?;
            }
        }
        Ok(())
    }
}

/// Whether `*` is a product of linear algebra.
fn is_product(a: &Type, b: &Type) -> bool {
    let is_matrix = |t: &Type| matches!(t, Type::Matrix { .. });
    let is_many = |t: &Type| matches!(t, Type::Matrix { .. } | Type::Vector(..));
    (is_matrix(a) && is_many(b)) || (is_many(a) && is_matrix(b))
}

/// Returns the operation on components.
pub(super) fn operation(op: BinaryOp, scalar: Scalar) -> Option<Two> {
    use BinaryOp::*;
    let float = scalar == Scalar::Float;
    let unsigned = scalar == Scalar::UInt;
    let pick = |f: Two, i: Two, u: Two| {
        Some(if float {
            f
        } else if unsigned {
            u
        } else {
            i
        })
    };
    let integer = |i: Two, u: Two| (!float).then_some(if unsigned { u } else { i });
    match op {
        Add => pick(Two::FAdd, Two::IAdd, Two::IAdd),
        Subtract => pick(Two::FSub, Two::ISub, Two::ISub),
        Multiply => pick(Two::FMul, Two::IMul, Two::IMul),
        Divide => pick(Two::FDiv, Two::IDiv, Two::UDiv),
        Remainder => integer(Two::IRem, Two::URem),
        ShiftLeft => integer(Two::Shl, Two::Shl),
        ShiftRight => integer(Two::ShrI, Two::ShrU),
        Less => pick(Two::FLess, Two::ILess, Two::ULess),
        Greater => pick(Two::FGreater, Two::IGreater, Two::UGreater),
        LessEqual => pick(Two::FLessEqual, Two::ILessEqual, Two::ULessEqual),
        GreaterEqual => pick(Two::FGreaterEqual, Two::IGreaterEqual, Two::UGreaterEqual),
        Equal => pick(Two::FEqual, Two::IEqual, Two::IEqual),
        NotEqual => pick(Two::FNotEqual, Two::INotEqual, Two::INotEqual),
        BitAnd => integer(Two::And, Two::And),
        BitOr => integer(Two::Or, Two::Or),
        BitXor | Xor => integer(Two::Xor, Two::Xor),
        And => integer(Two::And, Two::And),
        Or => integer(Two::Or, Two::Or),
    }
}

impl Compiler<'_> {
    pub(super) fn construct(&mut self, call: &Call, dst: Reg, ty: &Type, span: Span) -> Result<()> {
        match ty {
            Type::Struct(_) | Type::Array(..) => {
                let mut at = dst;
                for arg in &call.args {
                    self.evaluate_into(arg, at)?;
                    let of = self.type_of(arg)?;
                    at += self.size(&of, arg.span)?;
                }
                Ok(())
            }
            Type::Scalar(_) | Type::Vector(..) | Type::Matrix { .. } => self.construct_number(call, dst, ty, span),
            _ => Err(unsupported(format!("a constructor of `{ty}`"), span)),
        }
    }

    fn construct_number(&mut self, call: &Call, dst: Reg, ty: &Type, span: Span) -> Result<()> {
        let size = self.size(ty, span)?;
        let to = scalar_of(ty);
        if let [arg] = &call.args[..] {
            let from = self.type_of(arg)?;
            let value = self.evaluate(arg)?;
            match (ty, &from) {
                (Type::Matrix { columns, rows, .. }, Type::Matrix { columns: c, rows: r, .. }) => {
                    return self.resize(dst, value, (*columns, *rows), (*c, *r));
                }
                (Type::Matrix { columns, rows, .. }, Type::Scalar(scalar)) => {
                    let diagonal = self.allocate(1)?;
                    self.convert(diagonal, value, 1, *scalar, to)?;
                    for (column, row, at) in cells(*columns, *rows) {
                        let is_diagonal = column == row;
                        self.emit(match is_diagonal {
                            true => Instr::Copy { dst: dst + at, src: diagonal, n: 1 },
                            false => Instr::Constant { dst: dst + at, bits: 0 },
                        })?;
                    }
                    return Ok(());
                }
                (_, Type::Scalar(scalar)) => {
                    self.convert(dst, value, 1, *scalar, to)?;
                    for at in 1..size {
                        self.emit(Instr::Copy { dst: dst + at, src: dst, n: 1 })?;
                    }
                    return Ok(());
                }
                _ => {
                    let n = self.size(&from, span)?.min(size);
                    return self.convert(dst, value, n, scalar_of(&from), to);
                }
            }
        }
        let mut at = 0;
        for arg in &call.args {
            let from = self.type_of(arg)?;
            let all = self.size(&from, arg.span)?;
            let n = all.min(size.saturating_sub(at));
            if n == all && scalar_of(&from) == to {
                self.evaluate_into(arg, dst + at)?;
            } else {
                let next = self.next;
                let value = self.evaluate(arg)?;
                self.convert(dst + at, value, n, scalar_of(&from), to)?;
                self.next = next;
            }
            at += n;
        }
        Ok(())
    }

    /// A matrix of a matrix: the rest is that of the identity.
    fn resize(&mut self, dst: Reg, src: Reg, (columns, rows): (u8, u8), (c, r): (u8, u8)) -> Result<()> {
        for (column, row, at) in cells(columns, rows) {
            let dst = dst + at;
            self.emit(if column < c && row < r {
                Instr::Copy { dst, src: src + u32::from(column) * u32::from(r) + u32::from(row), n: 1 }
            } else {
                Instr::Constant { dst, bits: if column == row { 1.0_f32.to_bits() } else { 0 } }
            })?;
        }
        Ok(())
    }

    /// `{1.0, 2.0}`
    pub(super) fn list(&mut self, list: &[Expr], dst: Reg, ty: &Type, span: Span) -> Result<()> {
        let members: Vec<Type> = match ty {
            Type::Array(of, _) => vec![(**of).clone(); list.len()],
            Type::Vector(scalar, n) => vec![Type::Scalar(*scalar); usize::from(*n)],
            Type::Matrix { scalar, columns, rows } => {
                vec![Type::scalar_or_vector(*scalar, *rows); usize::from(*columns)]
            }
            Type::Struct(name) => self.layouts.members(name),
            other => vec![other.clone()],
        };
        let mut at = dst;
        if list.len() != members.len() {
            return Err(unsupported("an initializer list of this length", span));
        }
        for (value, member) in list.iter().zip(&members) {
            match &value.kind {
                ExprKind::List(inner) => self.list(inner, at, member, value.span)?,
                _ => self.evaluate_into(value, at)?,
            }
            at += self.size(member, value.span)?;
        }
        Ok(())
    }

    pub(super) fn constant(&mut self, value: f32) -> Result<Reg> {
        let dst = self.allocate(1)?;
        self.emit(Instr::Constant { dst, bits: value.to_bits() })?;
        Ok(dst)
    }
}

/// The cells of a matrix with their places: (column, row, place).
fn cells(columns: u8, rows: u8) -> impl Iterator<Item = (u8, u8, u32)> {
    (0..columns).flat_map(move |column| {
        (0..rows).map(move |row| (column, row, u32::from(column) * u32::from(rows) + u32::from(row)))
    })
}

/// Whether a type has components of floats.
pub(super) fn is_float(ty: &Type) -> bool {
    ty.scalar() == Some(Scalar::Float)
}
