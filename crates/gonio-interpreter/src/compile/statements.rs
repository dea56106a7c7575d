//! Statements, and calls of the shader's own functions, which are inlined. Code after a jump in the same block is not
//! compiled.

use super::{Compiler, Current, Result, Variable, unsupported};
use crate::code::{CallFrame, Instr, One, Reg, Two};
use crate::layout::scalar_of;
use gonio_glsl::ast::{Call, Condition, Declaration, has};
use gonio_glsl::{Expr, ExprKind, Scalar, Statement, StatementKind, SymbolKind, Type};

/// Whether control flow reaches the end of a statement.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Reaches {
    End,
    Nothing,
}

impl Compiler<'_> {
    pub(super) fn statement(&mut self, statement: &Statement) -> Result<Reaches> {
        self.enter(statement.span)?;
        let (next, place) = (self.next, self.place.take());
        // A block's own statements are recorded.
        if !matches!(statement.kind, StatementKind::Block(_) | StatementKind::Empty | StatementKind::Case(_))
            && let Some(id) = self.source.statement_id(statement)
        {
            self.emit(Instr::Statement { id })?;
        }
        let reaches = self.statement_kind(statement)?;
        if !matches!(statement.kind, StatementKind::Declaration(_)) {
            self.next = next;
        }
        self.place = place;
        self.nested -= 1;
        Ok(reaches)
    }

    fn statement_kind(&mut self, statement: &Statement) -> Result<Reaches> {
        match &statement.kind {
            StatementKind::Declaration(declaration) => self.local(declaration)?,
            StatementKind::Expression(expr) => {
                self.evaluate_unused(expr)?;
            }
            StatementKind::If { condition, then, otherwise } => {
                let condition = self.evaluate(condition)?;
                return self.branch(condition, then, otherwise.as_deref());
            }
            StatementKind::For { initial, condition, step, body } => {
                if let Some(initial) = initial {
                    self.statement(initial)?;
                }
                self.looped(condition.as_deref(), step.as_ref(), body)?;
            }
            StatementKind::While { condition, body } => self.looped(Some(condition), None, body)?,
            StatementKind::DoWhile { body, condition } => self.do_while(body, condition)?,
            StatementKind::Switch { value, body } => self.switch(value, body)?,
            StatementKind::Case(_) => {
                return Err(unsupported("a `case` inside a block of a `switch`", statement.span));
            }
            StatementKind::Return(value) => {
                if let Some(value) = value {
                    self.returned(value)?;
                }
                self.emit(Instr::Return)?;
                return Ok(Reaches::Nothing);
            }
            StatementKind::Break => {
                self.emit(Instr::Break)?;
                return Ok(Reaches::Nothing);
            }
            StatementKind::Continue => {
                self.emit(Instr::Continue)?;
                return Ok(Reaches::Nothing);
            }
            StatementKind::Discard => {
                let ends = self.discard_ends;
                self.emit(Instr::Discard { ends })?;
                return Ok(if ends { Reaches::Nothing } else { Reaches::End });
            }
            StatementKind::Block(list) => {
                for statement in list {
                    if self.statement(statement)? == Reaches::Nothing {
                        return Ok(Reaches::Nothing);
                    }
                }
            }
            StatementKind::Precision(_) | StatementKind::Empty => {}
        }
        Ok(Reaches::End)
    }

    fn returned(&mut self, value: &Expr) -> Result<()> {
        let returns = self.calls.last().and_then(|call| call.returns.clone());
        match returns {
            Some((dst, ty)) => {
                let n = self.size(&ty, value.span)?;
                let src = self.evaluate(value)?;
                self.emit(Instr::Store { dst, src, n })
            }
            None => self.evaluate_unused(value),
        }
    }

    /// Declares local variables. Their registers are written for all points, for no other point reads them before it
    /// comes to the declaration itself.
    fn local(&mut self, declaration: &Declaration) -> Result<()> {
        for declarator in &declaration.declarators {
            let Some(id) = self.symbol_at(declarator.tokens.first) else { continue };
            let Some(ty) = self.checked.symbols[id].ty.clone() else {
                return Err(unsupported(format!("`{}`, whose type is unknown", declarator.name), declarator.span));
            };
            let variable = self.variable(Some(id), &declarator.name, ty, Some(declarator.span))?;
            match &declarator.initialiser {
                Some(value) => self.initialise(value, &variable)?,
                None => self.forget(&variable)?,
            }
        }
        Ok(())
    }

    pub(super) fn initialise(&mut self, value: &Expr, variable: &Variable) -> Result<()> {
        let next = self.next;
        self.evaluate_into(value, variable.reg)?;
        self.emit(Instr::Wrote { variable: variable.traced })?;
        self.next = next;
        Ok(())
    }

    fn branch(&mut self, condition: Reg, then: &Statement, otherwise: Option<&Statement>) -> Result<Reaches> {
        let at = self.code.len();
        self.emit(Instr::If { condition, otherwise: 0 })?;
        let mut reaches = self.statement(then)?;
        let other = self.code.len();
        self.emit(Instr::Else { end: 0 })?;
        reaches = match otherwise {
            Some(otherwise) => {
                let other = self.statement(otherwise)?;
                if reaches == Reaches::Nothing { other } else { Reaches::End }
            }
            None => Reaches::End,
        };
        self.end_branch(condition, at, other)?;
        Ok(reaches)
    }

    /// Closes a branch whose `If` and `Else` are at these places.
    pub(super) fn end_branch(&mut self, condition: Reg, at: usize, other: usize) -> Result<()> {
        let end = self.here();
        self.code[at] = Instr::If { condition, otherwise: other as u32 };
        self.code[other] = Instr::Else { end };
        self.emit(Instr::EndIf)
    }

    fn looped(&mut self, condition: Option<&Condition>, step: Option<&Expr>, body: &Statement) -> Result<()> {
        self.emit(Instr::Loop)?;
        let start = self.here();
        let next = self.next;
        let test = match condition {
            Some(condition) => {
                let condition = match condition {
                    Condition::Expr(expr) => self.evaluate(expr)?,
                    Condition::Declaration(declaration) => {
                        self.local(declaration)?;
                        let token = declaration.declarators.last().map_or(0, |d| d.tokens.first);
                        let found = self.symbol_at(token).and_then(|id| self.variables.get(&id));
                        found.map(|v| v.reg).ok_or_else(|| unsupported("this condition", declaration.span))?
                    }
                };
                let at = self.code.len();
                self.emit(Instr::Test { condition, end: 0 })?;
                Some((at, condition))
            }
            None => None,
        };
        self.statement(body)?;
        self.emit(Instr::Next)?;
        if let Some(step) = step {
            self.evaluate_unused(step)?;
        }
        self.emit(Instr::Repeat { start })?;
        self.next = next;
        self.end_loop(test)
    }

    fn end_loop(&mut self, test: Option<(usize, Reg)>) -> Result<()> {
        let end = self.here();
        if let Some((at, condition)) = test {
            self.code[at] = Instr::Test { condition, end };
        }
        self.emit(Instr::EndLoop)
    }

    fn do_while(&mut self, body: &Statement, condition: &Expr) -> Result<()> {
        self.emit(Instr::Loop)?;
        let start = self.here();
        self.statement(body)?;
        self.emit(Instr::Next)?;
        let condition = self.evaluate(condition)?;
        let at = self.code.len();
        self.emit(Instr::Test { condition, end: 0 })?;
        self.emit(Instr::Repeat { start })?;
        self.end_loop(Some((at, condition)))
    }

    /// Compares with all labels first, because `default` stands for the values that no label has.
    fn switch(&mut self, value: &Expr, body: &[Statement]) -> Result<()> {
        let selector = self.evaluate(value)?;
        let mut conditions = Vec::new();
        let default = self.allocate(1)?;
        self.emit(Instr::Constant { dst: default, bits: 0 })?;
        for statement in body {
            let StatementKind::Case(label) = &statement.kind else { continue };
            conditions.push(match label {
                None => default,
                Some(label) => {
                    let condition = self.allocate(1)?;
                    let next = self.next;
                    let label = self.evaluate(label)?;
                    self.two(Two::IEqual, condition, selector, label)?;
                    self.two(Two::Or, default, default, condition)?;
                    self.next = next;
                    condition
                }
            });
        }
        self.emit(Instr::One { op: One::Not, dst: default, a: default, n: 1 })?;
        self.emit(Instr::Switch)?;
        let mut conditions = conditions.into_iter();
        let mut reaches = Reaches::End;
        for statement in body {
            if matches!(statement.kind, StatementKind::Case(_)) {
                if let Some(condition) = conditions.next() {
                    self.emit(Instr::Case { condition })?;
                }
                reaches = Reaches::End;
            } else if reaches == Reaches::End {
                reaches = self.statement(statement)?;
            }
        }
        self.emit(Instr::EndSwitch)
    }

    fn two(&mut self, op: Two, dst: Reg, a: Reg, b: Reg) -> Result<()> {
        self.emit(Instr::Two { op, dst, a, b, n: 1, steps: [0, 0] })
    }

    /// Evaluates an expression whose value is not used.
    pub(super) fn evaluate_unused(&mut self, expr: &Expr) -> Result<()> {
        let next = self.next;
        let is_void = expr.ty == Some(Type::Void);
        if is_void && !matches!(expr.kind, ExprKind::Call(_)) {
            return Err(unsupported("this expression without a value", expr.span));
        }
        self.evaluate(expr)?;
        self.next = next;
        Ok(())
    }

    /// Emits a conversion of `n` scalars; there is none between equal representations.
    pub(super) fn convert(&mut self, dst: Reg, src: Reg, n: u32, from: Scalar, to: Scalar) -> Result<()> {
        use Scalar::{Bool, Float, Int, UInt};
        let op = match (from, to) {
            (Float, Int) => One::FToI,
            (Float, UInt) => One::FToU,
            (Int, Float) => One::IToF,
            (UInt, Float) => One::UToF,
            (Float, Bool) => One::FToB,
            (Int | UInt, Bool) => One::IToB,
            (Bool, Float) => One::BToF,
            _ => return self.emit(Instr::Copy { dst, src, n }),
        };
        self.emit(Instr::One { op, dst, a: src, n })
    }
}

impl Compiler<'_> {
    /// Returns the shader's own function that is called; `None` for a built-in one.
    pub(super) fn called(&self, call: &Call) -> Option<usize> {
        let symbol = self.symbol_at(call.name_tokens.first)?;
        (self.checked.symbols[symbol].kind == SymbolKind::Function).then_some(symbol)
    }

    pub(super) fn call(&mut self, symbol: usize, call: &Call, expr: &Expr, dst: Reg) -> Result<()> {
        let Some(function) = self.functions.get(&symbol).copied() else {
            return Err(unsupported(format!("the function `{}`, which has no body", call.name), expr.span));
        };
        if self.calls.iter().any(|current| current.symbol == Some(symbol)) {
            return Err(unsupported(format!("the recursive call of `{}`", call.name), expr.span));
        }
        let returns = self.raw_type(expr)?;
        let frame = self.frames.len() as u32;
        let caller = self.frame;
        let depth = self.frames.get(caller as usize).map_or(0, |f| f.depth) + 1;
        self.frames.push(CallFrame {
            function: function.name.clone(),
            caller: Some(caller),
            call: self.source.id(expr),
            depth,
        });
        let (mut written, mut declared) = (Vec::new(), Vec::new());
        for (param, arg) in function.params.iter().zip(&call.args) {
            let id =
                self.symbol_at(param.tokens.first).filter(|id| self.checked.symbols[*id].kind == SymbolKind::Param);
            let ty = match id.and_then(|id| self.checked.symbols[id].ty.clone()) {
                Some(ty) => ty,
                // Without a name it has no symbol.
                None => self.type_of(arg)?,
            };
            let variable = self.variable(id, &param.name, ty, Some(param.span))?;
            declared.extend(id.map(|id| (id, variable.clone())));
            let is_inout = has(&param.qualifiers, "inout");
            if !is_inout && !has(&param.qualifiers, "out") {
                self.evaluate_into(arg, variable.reg)?;
                self.emit(Instr::Wrote { variable: variable.traced })?;
                continue;
            }
            let place = self.place(arg)?;
            if scalar_of(&place.ty) != scalar_of(&variable.ty) && is_inout {
                return Err(unsupported("a conversion of an `inout` argument", arg.span));
            }
            if is_inout {
                self.load(variable.reg, &place)?;
                self.emit(Instr::Wrote { variable: variable.traced })?;
            } else {
                self.forget(&variable)?;
            }
            written.push((place, variable, arg.span));
        }
        let n = self.size(&returns, expr.span)?;
        let returned = self.allocate(n)?;
        if n > 0 {
            self.emit(Instr::Forget { dst: returned, n })?;
        }
        let returns = (returns != Type::Void).then_some((returned, returns));
        // An argument may have called the same function, whose parameters were others.
        self.variables.extend(declared);
        self.calls.push(Current { symbol: Some(symbol), returns });
        self.frame = frame;
        self.emit(Instr::Enter { frame })?;
        for statement in function.body.iter().flatten() {
            if self.statement(statement)? == Reaches::Nothing {
                break;
            }
        }
        self.emit(Instr::Leave)?;
        self.frame = caller;
        self.calls.pop();
        for (place, variable, span) in written {
            let (from, to) = (scalar_of(&variable.ty), scalar_of(&place.ty));
            if from == to {
                self.store(&place, variable.reg, span)?;
            } else {
                let n = self.size(&place.ty, span)?;
                let converted = self.allocate(n)?;
                self.convert(converted, variable.reg, n, from, to)?;
                self.store(&place, converted, span)?;
            }
        }
        if self.raw_type(expr)?.components().is_some() {
            self.emit(Instr::Load { dst, src: returned, n })?;
        } else if n > 0 {
            self.emit(Instr::Copy { dst, src: returned, n })?;
        }
        Ok(())
    }
}
