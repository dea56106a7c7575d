//! Watches expressions, replaces their values, and records the steps of one point.

use super::control::Control;
use super::registers::{Operand, Registers};
use super::{Machine, float_operation};
use crate::code::{CompiledStage, Instr, Reg};
use crate::lanes::{LANES, LaneSet};
use crate::math::f;
use crate::run::{AnomalyKind, Evaluation, PointValues, RunOptions, Substitute, TraceStep, TraceWrite};
use crate::source::{ExprId, StatementId};

/// Most steps of a trace.
const MOST_STEPS: usize = 100_000;
/// Most scalars of a variable in a trace.
const MOST_TRACED: u32 = 256;

/// A variable that was just written.
pub(crate) struct Write {
    pub variable: u32,
    pub expr: Option<ExprId>,
    pub reg: Reg,
    pub size: u32,
}

/// What is to be done with an expression.
#[derive(Clone, Copy, Default)]
struct Mark {
    is_watched: bool,
    is_replaced: bool,
}

/// What was seen of a run.
pub(crate) struct Seen {
    /// By expression; empty if none is watched or replaced.
    marks: Vec<Mark>,
    /// How often each expression was evaluated in this block.
    occurrences: Vec<u32>,
    pub evaluations: Vec<Evaluation>,
    /// Numbers that evaluations may still take.
    space: usize,
    pub is_truncated: bool,
    traced_point: Option<usize>,
    /// The lane of the traced point in this block.
    traced_lane: Option<usize>,
    pub steps: Vec<TraceStep>,
    /// Where the first infinity or NaN of each lane arose.
    origins: Vec<Option<ExprId>>,
    pub all_origins: Vec<Option<ExprId>>,
}

impl Seen {
    pub fn new(stage: &CompiledStage, options: &RunOptions<'_>) -> Self {
        let mut marks = Vec::new();
        if !options.watched.is_empty() || !options.substitutes.is_empty() {
            marks.resize(stage.source.expressions.len(), Mark::default());
        }
        for expr in options.watched {
            if let Some(mark) = marks.get_mut(expr.0 as usize) {
                mark.is_watched = true;
            }
        }
        for substitute in options.substitutes {
            if let Some(mark) = marks.get_mut(substitute.expr.0 as usize) {
                mark.is_replaced = true;
            }
        }
        Self {
            occurrences: vec![0; marks.len()],
            marks,
            evaluations: Vec::new(),
            space: options.most_observed,
            is_truncated: false,
            traced_point: options.traced_point,
            traced_lane: None,
            steps: Vec::new(),
            origins: Vec::new(),
            all_origins: Vec::new(),
        }
    }

    pub fn start_block(&mut self, start: usize) {
        self.occurrences.fill(0);
        self.traced_lane = self.traced_point.and_then(|point| point.checked_sub(start)).filter(|lane| *lane < LANES);
        self.origins.clear();
        self.origins.resize(LANES, None);
    }

    pub fn end_block(&mut self, count: usize) {
        self.all_origins.extend(self.origins.iter().take(count));
    }

    #[inline(always)]
    pub fn is_watching(&self) -> bool {
        !self.marks.is_empty()
    }

    #[inline(always)]
    pub fn is_tracing(&self) -> bool {
        self.traced_lane.is_some()
    }

    #[inline(always)]
    pub fn statement(&mut self, statement: StatementId, visible: LaneSet, control: &Control) {
        let Some(lane) = self.traced_lane else { return };
        if !visible.contains(lane) {
            return;
        }
        if self.steps.len() >= MOST_STEPS {
            self.is_truncated = true;
            return;
        }
        let (frame, iterations) = (control.frame(), control.iterations());
        self.steps.push(TraceStep { statement: Some(statement), frame, iterations, writes: Vec::new() });
    }

    pub fn wrote(&mut self, write: Write, visible: LaneSet, control: &Control, registers: &Registers) {
        let Some(lane) = self.traced_lane.filter(|lane| visible.contains(*lane)) else { return };
        if self.is_truncated {
            return;
        }
        let (frame, iterations) = (control.frame(), control.iterations());
        if self.steps.last().is_none_or(|step| step.frame != frame || step.iterations != iterations) {
            // A call or the body of a loop has ended, and the statement around it goes on. Global variables are
            // initialized before the first statement.
            let is_around = |step: &&TraceStep| step.frame == frame && iterations.starts_with(&step.iterations);
            let statement = self.steps.iter().rev().find(is_around).and_then(|step| step.statement);
            self.steps.push(TraceStep { statement, frame, iterations, writes: Vec::new() });
        }
        let Some(step) = self.steps.last_mut() else { return };
        let Write { variable, expr, reg, size } = write;
        let all = reg..reg + size.min(MOST_TRACED);
        let values = all.clone().map(|reg| registers.operand(reg).at(lane)).collect();
        let written = all.map(|reg| registers.written(reg).contains(lane)).collect();
        step.writes.push(TraceWrite { variable, expr, values, written });
    }

    pub fn has_origin(&self, lane: usize) -> bool {
        self.origins.get(lane).copied().flatten().is_some()
    }
}

impl Machine<'_> {
    /// Records the value of a watched expression, and replaces it.
    pub(super) fn mark(&mut self, expr: ExprId, reg: Reg, n: u32) {
        let index = expr.0 as usize;
        let mark = self.seen.marks.get(index).copied().unwrap_or_default();
        if !mark.is_watched && !mark.is_replaced {
            return;
        }
        let occurrence = self.seen.occurrences[index];
        self.seen.occurrences[index] += 1;
        if mark.is_replaced {
            let is_now = |s: &&Substitute| s.expr == expr && s.occurrence.is_none_or(|only| only == occurrence);
            for substitute in self.options.substitutes.iter().filter(is_now) {
                self.replace(reg, n, &substitute.values);
            }
        }
        if mark.is_watched {
            self.record(expr, reg, n, occurrence);
        }
    }

    fn replace(&mut self, reg: Reg, n: u32, values: &PointValues) {
        let active = self.control.active();
        if active.is_empty() {
            return;
        }
        for at in 0..n {
            let start = self.start;
            let old: Vec<u32> = (0..LANES).map(|lane| self.registers.operand(reg + at).at(lane)).collect();
            let written = self.registers.written(reg + at).or(active);
            let value = |lane: usize| {
                let new = values.component(at as usize, start + lane).filter(|_| active.contains(lane));
                new.unwrap_or(old[lane])
            };
            match values {
                PointValues::Same(components) if active.covers(self.valid) => {
                    if let Some(bits) = components.get(at as usize) {
                        self.registers.set(reg + at, *bits, LaneSet::FULL);
                    }
                }
                _ => self.registers.set_each(reg + at, written, value),
            }
        }
    }

    fn record(&mut self, expr: ExprId, reg: Reg, n: u32, occurrence: u32) {
        let points = self.control.visible().and(self.valid);
        if points.is_empty() {
            return;
        }
        let is_same = (0..n).all(|at| matches!(self.registers.operand(reg + at), Operand::Same(_)));
        let count = self.valid.count();
        let needed = n as usize * if is_same { 1 } else { count } + 16;
        if needed > self.seen.space {
            self.seen.is_truncated = true;
            return;
        }
        self.seen.space -= needed;
        let written = (0..n).fold(LaneSet::FULL, |w, at| w.and(self.registers.written(reg + at)));
        let values = match is_same {
            true => PointValues::Same((0..n).map(|at| self.registers.operand(reg + at).at(0)).collect()),
            false => PointValues::Each {
                components: (0..n).map(|at| self.registers.operand(reg + at).first(count)).collect(),
                written: None,
            },
        };
        self.seen.evaluations.push(Evaluation {
            expr,
            frame: self.control.frame(),
            iterations: self.control.iterations(),
            occurrence,
            first_point: self.start,
            points,
            written,
            values,
        });
    }

    /// Notes points where this instruction computes an infinity or NaN from finite numbers.
    pub(super) fn find_non_finite(&mut self, instr: &Instr, place: Option<ExprId>) {
        let Some((dst, n, operands)) = float_operation(instr, self.stage) else { return };
        let visible = self.control.visible();
        let mut arose = LaneSet::EMPTY;
        for at in 0..n {
            arose = arose.or(self.non_finite(dst + at));
        }
        arose = arose.and(visible);
        for (reg, n) in operands {
            if arose.is_empty() {
                return;
            }
            for at in 0..n {
                arose = arose.without(self.non_finite(reg + at));
            }
        }
        if arose.is_empty() {
            return;
        }
        for lane in arose.iter().filter(|lane| !self.seen.has_origin(*lane)).collect::<Vec<_>>() {
            self.seen.origins[lane] = place;
        }
        self.note(AnomalyKind::NonFinite, place, arose);
    }

    fn non_finite(&self, reg: Reg) -> LaneSet {
        match self.registers.operand(reg) {
            Operand::Same(bits) if f(bits).is_finite() => LaneSet::EMPTY,
            Operand::Same(_) => LaneSet::FULL,
            Operand::Each(row) if row.iter().all(|bits| f(*bits).is_finite()) => LaneSet::EMPTY,
            Operand::Each(row) => LaneSet::filter(|lane| !f(row[lane]).is_finite()),
        }
    }
}
