//! Expressions: each is evaluated into registers that nothing else uses, so that its value can be replaced.

use super::{Compiler, Result, unsupported};
use crate::code::{Instr, One, Reg, Two};
use crate::layout::scalar_of;
use gonio_glsl::ast::{BinaryOp, Literal, UnaryOp};
use gonio_glsl::{Expr, ExprKind, Scalar, Type};

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
            self.convert(dst, value, n, scalar_of(&raw), scalar_of(&to), expr.span)?;
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
                    Literal::Float(value) => (*value as f32).to_bits(),
                    Literal::Bool(value) => u32::from(*value),
                    Literal::Double(_) => return Err(unsupported("`double`", expr.span)),
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
                let src = self.evaluate(otherwise)?;
                self.emit(Instr::Store { dst, src, n })?;
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
