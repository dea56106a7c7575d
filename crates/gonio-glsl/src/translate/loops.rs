//! Bounds the number of loop iterations. In a browser a draw call cannot be aborted, and other drivers end long loops
//! by themselves and keep drawing, so the same iterations are counted in every context.

use super::Translator;
use crate::ast::{BinaryOp, Call, Condition, Expr, ExprKind, Function, Item, Statement, StatementKind, UnaryOp, has};
use crate::check::{Storage, SymbolKind};
use crate::walk::{Visitor, walk_expression, walk_statement, walk_unit};
use crate::{Checked, Scalar, Stage, TokenRange, Type, Unit};
use std::collections::{BTreeSet, HashMap, HashSet};

/// The number of iterations after which loops are ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LoopBound {
    /// Iterations that all loops of a shader may take together, for one vertex or fragment.
    pub turns: u32,
}

impl LoopBound {
    /// The bound for students' shaders: a thousand times the iterations of loops over lights and samples, and below
    /// 65,535: after that many llvmpipe (Mesa 22.3) silently leaves all loops, counting for 4 to 16 pixels together.
    pub const STUDENTS: Self = Self { turns: 50_000 };
}

/// The uniform of a bounded shader (a `bool`). While it is false, vertices and fragments with too many iterations are
/// not drawn; while it is true, such fragments are drawn, and such vertices are scattered over the image.
pub const DRAWN_ALL_THE_SAME: &str = "gonio_drawn_all_the_same";

const COUNT: &str = "gonio_turns";

impl Translator<'_> {
    /// Makes each loop body count an iteration and leave its loop after the bound. Shaders whose loops evidently end
    /// within the bound stay unchanged, so that compilers unroll them as usual.
    pub(super) fn bound_loops(&mut self, bound: LoopBound) {
        let turns = bound.turns;
        if most_turns(&self.parsed.unit, self.checked).is_some_and(|most| most <= u64::from(turns)) {
            return;
        }
        let mut found = Found::default();
        walk_unit(&self.parsed.unit, &mut found);
        // A macro that is used twice is changed once.
        let bodies: BTreeSet<_> = found.bodies.into_iter().filter_map(|tokens| self.stretch(tokens)).collect();
        if bodies.is_empty() {
            return;
        }
        for (start, end) in bodies {
            self.edits.surround(start, end, &format!("{{ if (++{COUNT} > {turns}) break; "), " }");
        }
        // A discarded fragment would not reveal its loop.
        let discards: BTreeSet<_> = found.discards.into_iter().filter_map(|tokens| self.stretch(tokens)).collect();
        for (start, end) in discards {
            self.edits.surround(start, end, &format!("{{ if ({COUNT} <= {turns}) "), " }");
        }
        self.preamble.insert(format!("int {COUNT} = 0;"));
        self.preamble.insert(format!("uniform bool {DRAWN_ALL_THE_SAME};"));
        let vanish = match self.stage() {
            Stage::Vertex => {
                // Scattered over the whole image, so that triangles have an area whatever the numbers of their
                // vertices.
                let place = |step: &str| format!("fract({step} * float(gl_VertexID)) * 3.0 - 1.5");
                let scattered = format!("vec4({}, {}, 0.0, 1.0)", place("0.618034"), place("0.754878"));
                format!("gl_Position = {DRAWN_ALL_THE_SAME} ? {scattered} : vec4(2.0, 2.0, 2.0, 1.0);")
            }
            Stage::Fragment => format!("if (!{DRAWN_ALL_THE_SAME}) discard;"),
        };
        self.after_main.push_str(&format!("if ({COUNT} > {turns}) {{ {vanish} }} "));
    }
}

#[derive(Default)]
struct Found {
    bodies: Vec<TokenRange>,
    discards: Vec<TokenRange>,
}

impl Visitor for Found {
    fn statement(&mut self, statement: &Statement) -> bool {
        match &statement.kind {
            StatementKind::For { body, .. }
            | StatementKind::While { body, .. }
            | StatementKind::DoWhile { body, .. } => self.bodies.push(body.tokens),
            StatementKind::Discard => self.discards.push(statement.tokens),
            _ => {}
        }
        true
    }
}

/// Counters stay below this, so that none overflows.
const MOST_VALUE: f64 = 1e9;
/// Least step of a `float` counter relative to its largest value: smaller ones vanish in rounding.
const LEAST_STEP: f64 = 1e-5;
/// Built-in functions that write to an argument.
const WRITERS: [&str; 6] = ["modf", "frexp", "uaddCarry", "usubBorrow", "umulExtended", "imulExtended"];

/// Returns an upper bound for the iterations of all loops in one run of `main`; `None` if it cannot be determined.
fn most_turns(unit: &Unit, checked: &Checked) -> Option<u64> {
    let writers = unit.items.iter().filter_map(|item| match item {
        Item::Function(function) => {
            let writes = function.params.iter().any(|p| has(&p.qualifiers, "out") || has(&p.qualifiers, "inout"));
            writes.then_some(&*function.name)
        }
        _ => None,
    });
    let mut turns =
        Turns { constants: constants(checked), writers: writers.chain(WRITERS).collect(), of: HashMap::new() };
    for item in &unit.items {
        if let Item::Function(function) = item {
            turns.function(function);
        }
    }
    turns.of.get("main").copied().unwrap_or(Some(0))
}

/// Returns constants that are numbers, by name, if the name has no other meaning anywhere in the shader.
fn constants(checked: &Checked) -> HashMap<&str, f64> {
    let mut found: HashMap<&str, Option<f64>> = HashMap::new();
    for (id, symbol) in checked.symbols.iter().enumerate() {
        let is_constant = symbol.kind == SymbolKind::Global && symbol.storage == Storage::Const;
        let value = checked.values.get(&id).filter(|value| is_constant && value.len() == 1).map(|value| value[0]);
        found.entry(&symbol.name).and_modify(|known| *known = None).or_insert(value);
    }
    found.into_iter().filter_map(|(name, value)| Some((name, value?))).collect()
}

struct Turns<'t> {
    constants: HashMap<&'t str, f64>,
    /// Functions that write to arguments.
    writers: HashSet<&'t str>,
    /// Iterations of each function so far, all overloads together; a function that is defined after its use is unknown
    /// there.
    of: HashMap<&'t str, Option<u64>>,
}

impl<'t> Turns<'t> {
    fn function(&mut self, function: &'t Function) {
        let found = match &function.body {
            Some(body) => self.statements(body),
            None => None,
        };
        let before = self.of.get(&*function.name).copied();
        // For a prototype, the body counts.
        let all = match before {
            None | Some(None) => found,
            Some(Some(before)) => found.and_then(|found| before.checked_add(found)),
        };
        self.of.insert(&function.name, all);
    }

    fn statements(&self, list: &[Statement]) -> Option<u64> {
        list.iter().try_fold(0_u64, |sum, statement| sum.checked_add(self.statement(statement)?))
    }

    fn statement(&self, statement: &Statement) -> Option<u64> {
        match &statement.kind {
            StatementKind::While { .. } | StatementKind::DoWhile { .. } => None,
            StatementKind::For { initial, condition, step, body } => {
                let turns = self.turns(initial.as_deref(), condition.as_deref(), step.as_ref(), body)?;
                let Some(Condition::Expr(condition)) = condition.as_deref() else { return None };
                let each = [self.calls(condition)?, self.calls(step.as_ref()?)?, self.statement(body)?];
                let each = each.iter().try_fold(1_u64, |sum, part| sum.checked_add(*part))?;
                let before = self.calls(condition)?.checked_add(self.statement(initial.as_deref()?)?)?;
                each.checked_mul(turns)?.checked_add(before)
            }
            StatementKind::If { condition, then, otherwise } => {
                let otherwise = otherwise.as_deref().map_or(Some(0), |otherwise| self.statement(otherwise))?;
                self.calls(condition)?.checked_add(self.statement(then)?)?.checked_add(otherwise)
            }
            StatementKind::Switch { value, body } => self.calls(value)?.checked_add(self.statements(body)?),
            StatementKind::Block(list) => self.statements(list),
            _ => {
                let mut called = Called { turns: self, sum: Some(0) };
                walk_statement(statement, &mut called);
                called.sum
            }
        }
    }

    /// Returns the iterations of the functions that an expression calls.
    fn calls(&self, expr: &Expr) -> Option<u64> {
        let mut called = Called { turns: self, sum: Some(0) };
        walk_expression(expr, &mut called);
        called.sum
    }

    /// Returns the iterations of a loop: 8 for `for (int i = 0; i < 8; i++)` if nothing else writes to `i`.
    fn turns(
        &self,
        initial: Option<&Statement>,
        condition: Option<&Condition>,
        step: Option<&Expr>,
        body: &Statement,
    ) -> Option<u64> {
        let StatementKind::Declaration(declaration) = &initial?.kind else { return None };
        let [counter] = declaration.declarators.as_slice() else { return None };
        let scalar = Type::named(&declaration.ty.name)?.scalar()?;
        let first = self.value(counter.initialiser.as_ref()?)?;
        let Condition::Expr(condition) = condition? else { return None };
        let ExprKind::Binary { op, left, right } = &condition.kind else { return None };
        let last = self.value(right)?;
        let step = self.step(step?, &counter.name)?;
        let is_written = self.is_written(body, &counter.name);
        if !is_name(left, &counter.name) || first.abs() > MOST_VALUE || last.abs() > MOST_VALUE || is_written {
            return None;
        }
        let is_enough = match scalar {
            Scalar::Int => step.abs() >= 1.0,
            // An unsigned counter wraps around below zero.
            Scalar::UInt => step >= 1.0,
            Scalar::Float => step.abs() > LEAST_STEP * first.abs().max(last.abs()),
            _ => false,
        };
        if !is_enough || step.abs() > MOST_VALUE {
            return None;
        }
        let way = match op {
            BinaryOp::Less | BinaryOp::LessEqual if step > 0.0 => last - first,
            BinaryOp::Greater | BinaryOp::GreaterEqual if step < 0.0 => first - last,
            _ => return None,
        };
        // One more for `<=`, and one for the rounding of a `float`.
        Some(if way < 0.0 { 0 } else { (way / step.abs()).ceil() as u64 + 2 })
    }

    fn value(&self, expr: &Expr) -> Option<f64> {
        let named = |name: &str| self.constants.get(name).map(|value| vec![*value]);
        match crate::constant::evaluate(expr, &named)?.as_slice() {
            [value] if value.is_finite() => Some(*value),
            _ => None,
        }
    }

    /// Returns the change of the counter per iteration.
    fn step(&self, expr: &Expr, counter: &str) -> Option<f64> {
        match &expr.kind {
            ExprKind::Unary { op, operand } if is_name(operand, counter) => match op {
                UnaryOp::PreIncrement | UnaryOp::PostIncrement => Some(1.0),
                UnaryOp::PreDecrement | UnaryOp::PostDecrement => Some(-1.0),
                _ => None,
            },
            ExprKind::Assign { op: Some(op), target, value } if is_name(target, counter) => match op {
                BinaryOp::Add => self.value(value),
                BinaryOp::Subtract => self.value(value).map(|value| -value),
                _ => None,
            },
            _ => None,
        }
    }

    fn is_written(&self, body: &Statement, counter: &str) -> bool {
        struct Writes<'w> {
            writers: &'w HashSet<&'w str>,
            counter: &'w str,
            found: bool,
        }
        impl Visitor for Writes<'_> {
            fn expression(&mut self, expr: &Expr) -> bool {
                self.found |= match &expr.kind {
                    ExprKind::Assign { target, .. } => is_name(target, self.counter),
                    ExprKind::Unary { op, operand } => is_written_by(*op) && is_name(operand, self.counter),
                    ExprKind::Call(Call { name, args, .. }) => {
                        self.writers.contains(&**name) && args.iter().any(|arg| is_name(arg, self.counter))
                    }
                    _ => false,
                };
                true
            }
        }
        let mut writes = Writes { writers: &self.writers, counter, found: false };
        walk_statement(body, &mut writes);
        writes.found
    }
}

struct Called<'c, 't> {
    turns: &'c Turns<'t>,
    sum: Option<u64>,
}

impl Visitor for Called<'_, '_> {
    fn expression(&mut self, expr: &Expr) -> bool {
        if let ExprKind::Call(call) = &expr.kind
            && let Some(of) = self.turns.of.get(&*call.name)
        {
            self.sum = self.sum.zip(*of).and_then(|(sum, of)| sum.checked_add(of));
        }
        true
    }
}

fn is_name(expr: &Expr, name: &str) -> bool {
    matches!(&expr.kind, ExprKind::Name(found) if found == name)
}

fn is_written_by(op: UnaryOp) -> bool {
    use UnaryOp::{PostDecrement, PostIncrement, PreDecrement, PreIncrement};
    matches!(op, PreIncrement | PreDecrement | PostIncrement | PostDecrement)
}
